//! Errors of later rooms, told at the place in the file that they are about; numbers for people.

use crate::graphical::construction::{Construction, Stiffness};
use crate::graphical::{DrawError, Missing, Parting, Round, Unplaced};
use crate::mechanism::force::{Heaviness, Sought, SpringKind};
use crate::mechanism::quantity::{Answer, Indeterminate, Stuck, Unit};
use crate::mechanism::statement::{Locus, Standing};
use crate::mechanism::structure::{Joint, StructureError, TrialDriver};
use crate::mechanism::{Input, LinkId, Mechanism, Path, Place, PointId, Rider};
pub(crate) use crate::scene::units::short;
use crate::scene::{Diagnostic, Scene, Subject};
use crate::solve::SolveError;
use crate::sweep::PositionError;

/// The diagnostic of an error that was found after reading, at the place in the file that it is about.
#[must_use]
pub fn diagnose(scene: &Scene, error: &SolveError) -> Diagnostic {
    let (subject, what, mend) = match error {
        SolveError::Structure(error) => structure(&scene.mechanism, error),
        SolveError::Draw(error) => draw(scene, error),
        SolveError::Position(error) => position(scene, error),
        SolveError::Unanswered { why, .. } => {
            let mend = match idle(&scene.mechanism, why) {
                Some(Sought::Spin) => "give a link that swings out a mass off the axis (`masses`)",
                Some(_) => "turn the input a little, or seek what has an arm",
                None => "change what this names, or ask for something that has an answer here",
            };
            (Subject::Asked(0), error.to_string(), mend.to_owned())
        }
        SolveError::Stuck { how: Stuck::Locked, .. } => (
            Subject::Scene,
            error.to_string(),
            "less friction, or another position, lets it move; `expect` tells that it is meant to lock"
                .to_owned(),
        ),
        SolveError::Stuck { how: Stuck::AtRest, .. } => (
            Subject::Inputs,
            error.to_string(),
            "turn the input a little; at this position a pair that rubs is at rest".to_owned(),
        ),
        SolveError::Stuck { .. } => (
            Subject::Scene,
            error.to_string(),
            "less friction leaves one balance; `expect` tells that it is meant so".to_owned(),
        ),
        SolveError::Indeterminate { why: Indeterminate::Room { points }, .. } => (
            Subject::Inputs,
            error.to_string(),
            format!("state where {} stands with less room (`within`)", points.join(" and ")),
        ),
        SolveError::Indeterminate { why: Indeterminate::Unclear, .. } => (
            Subject::Inputs,
            error.to_string(),
            "turn the input away from the dead centre, or compute with more digits (`--arith dd`)".to_owned(),
        ),
        SolveError::Indeterminate { why: Indeterminate::NoEquilibrium { .. }, .. } => (
            Subject::Scene,
            error.to_string(),
            "other loads or another position may have one; `expect` tells that it is meant so".to_owned(),
        ),
        SolveError::Indeterminate { .. } => (
            Subject::Inputs,
            error.to_string(),
            "turn the input a little; at this position it does not determine what is asked".to_owned(),
        ),
    };
    scene.source.complain(subject, what, Some(mend))
}

/// What is sought and does no work here, where that is the reason.
fn idle(mechanism: &Mechanism, why: &Indeterminate) -> Option<Sought> {
    let Indeterminate::Undefined { why } = why else { return None };
    mechanism.named_sought().into_iter().find(|sought| mechanism.say_idle(*sought) == *why)
}

/// The spring of a stiffness that was sought, the unit in which that is told, and this unit in SI.
#[must_use]
pub fn stiffness(of: &Stiffness, scene: &Scene) -> (String, String, f64) {
    let spring = &scene.mechanism.forces.springs[of.spring];
    let unit = &scene.units.stiffness;
    match spring.kind {
        SpringKind::Pull(_) => (spring.name.clone(), unit.symbol.clone(), unit.si),
        SpringKind::Torsion(_) => (spring.name.clone(), "N*m/rad".to_owned(), 1.0),
    }
}

/// The rough places of `near` that do not hold, though they have chosen what they could: a rod does not reach to the other
/// side of its block.
#[must_use]
pub fn unheld_hints(scene: &Scene, construction: &Construction) -> Vec<Diagnostic> {
    let mechanism = &scene.mechanism;
    let [x, y] = crate::graphical::origin(mechanism);
    let space = &construction.space;
    let world = |at: [f64; 2]| [x + at[0] * space.metres_per_mm, y + at[1] * space.metres_per_mm];
    let places: Vec<Option<[f64; 2]>> = space.places.iter().map(|at| at.map(world)).collect();
    let size = space.size();
    let unit = &scene.units.length;
    let mut told = Vec::new();
    for (index, at) in places.iter().enumerate() {
        let point = mechanism.point(PointId(index));
        let (Some(at), Place::Near(hint)) = (at, point.place) else { continue };
        let away = libm::hypot(at[0] - hint[0], at[1] - hint[1]);
        if away > crate::graphical::FAR_FROM_HINT * size {
            let [px, py] = at.map(|x| short(x / unit.si));
            let name = &point.name;
            told.push(scene.source.complain(
                Subject::Place(PointId(index)),
                format!(
                    "the rough place of {name} does not hold: it stands at [{px}, {py}], {} {} from there",
                    short(away / unit.si),
                    unit.symbol
                ),
                Some("correct it, or the dimensions that bring the point elsewhere".to_owned()),
            ));
        }
    }
    told
}

/// A g that nobody means: a number without a unit is in the lengths of the scene.
#[must_use]
pub fn light_gravity(scene: &Scene) -> Option<Diagnostic> {
    /// Below it no g is meant, m/s²: that of the Moon is 1.62.
    const LIGHT: f64 = 1.0;
    let forces = &scene.mechanism.forces;
    let g = forces.gravity.g.value;
    let used =
        forces.gravity.acts || forces.masses.iter().any(|m| matches!(m.heaviness, Heaviness::Weight(_)));
    (used && g < LIGHT && scene.units.length.si != 1.0).then(|| {
        scene.source.complain(
            Subject::Scene,
            format!(
                "g is {} m/s^2: a number without a unit is in {}/s^2",
                short(g),
                scene.units.length.symbol
            ),
            Some("write it with its unit, \"9.81 m/s^2\"".to_owned()),
        )
    })
}

fn position(scene: &Scene, error: &PositionError) -> (Subject, String, String) {
    let place = |at: f64| match scene.mechanism.inputs.first() {
        Some(Input::Slide { .. }) => {
            format!("{} {}", short(at / scene.units.length.si), scene.units.length.symbol)
        }
        _ => format!("{} {}", short(at / scene.units.angle.si), scene.units.angle.symbol),
    };
    match error {
        PositionError::Range(at) | PositionError::Far(at) => (
            Subject::Sheet,
            format!("the position with the input at {}: {error}", place(*at)),
            "`linkgram sweep` tells from where to where the input goes".to_owned(),
        ),
        PositionError::NoOtherAssembly => {
            (Subject::Sheet, error.to_string(), "leave `other_assembly` out".to_owned())
        }
        PositionError::Sweep(_) => (
            Subject::Sheet,
            format!("other positions cannot be drawn: {error}"),
            "leave `positions` and `other_assembly` out".to_owned(),
        ),
    }
}

fn structure(mechanism: &Mechanism, error: &StructureError) -> (Subject, String, String) {
    match error {
        StructureError::UnderConstrained { left, .. } => (
            Subject::Inputs,
            error.to_string(),
            format!(
                "give {left} more input{}, or join or guide these links",
                if *left == 1 { "" } else { "s" }
            ),
        ),
        StructureError::OverConstrained { joint, .. } => (
            match *joint {
                Joint::Pin(link, _) => Subject::Link(link),
                Joint::Slide(index) => Subject::Slide(index),
                Joint::Roll(index) | Joint::Contact(index) => Subject::Roll(index),
                Joint::Input(index) => Subject::Input(index),
                Joint::Trial(TrialDriver::Turn(link)) | Joint::TurnsWith(link, _) => Subject::Link(link),
                Joint::Trial(TrialDriver::Slide(slide)) => Subject::Slide(slide),
            },
            error.to_string(),
            match joint {
                Joint::Input(_) if mechanism.inputs.len() > 1 => "take this input away".to_owned(),
                Joint::Input(_) if mechanism.inputs.len() == 1 && is_rigid(error) => {
                    "take a link or a pair away: the chain is rigid".to_owned()
                }
                Joint::Input(_) => "drive a slide, or another link".to_owned(),
                _ => "take a link, a pair or an input away".to_owned(),
            },
        ),
    }
}

/// Whether the count leaves nothing to move.
fn is_rigid(error: &StructureError) -> bool {
    let (StructureError::UnderConstrained { mobility, .. }
    | StructureError::OverConstrained { mobility, .. }) = error;
    mobility.freedoms < 1
}

/// How fast bodies come apart, in the scene's units.
fn rate_of(how: Parting, scene: &Scene) -> String {
    let (length, time) = (&scene.units.length, &scene.units.time);
    let (rate, per, power) = match how {
        Parting::Speed(rate) => (rate, time.si, ""),
        Parting::Acceleration(rate) => (rate, time.si * time.si, "^2"),
    };
    format!("{} {}/{}{power}", short(rate.abs() * per / length.si), length.symbol, time.symbol)
}

fn draw(scene: &Scene, error: &DrawError) -> (Subject, String, String) {
    let unit = &scene.units.length;
    match error {
        DrawError::CannotAssemble { pin, why, range } => (
            if range.is_some() { Subject::Input(0) } else { Subject::Point(*pin) },
            format!("cannot be assembled: {}", why.in_unit(unit.si, &unit.symbol)),
            match range {
                Some(range) => range.to_string(),
                None => "change the dimensions or the input".to_owned(),
            },
        ),
        DrawError::Ambiguous { pin, first, second } => {
            let name = &scene.mechanism.point(*pin).name;
            let place = |p: &[f64; 2]| format!("[{}, {}]", short(p[0] / unit.si), short(p[1] / unit.si));
            let (first, second) = (place(first), place(second));
            (
                Subject::Place(*pin),
                match scene.mechanism.statement_of(*pin) {
                    Some(stated) => {
                        let loci = stated.loci.map(|locus| locus_in_words(scene, &locus)).join(" and ");
                        format!("ambiguous: {loci} meet in {first} and in {second}")
                    }
                    None => {
                        let both =
                            format!("ambiguous: the chain closes with {name} at {first} and at {second}");
                        match scene.mechanism.point(*pin).place {
                            Place::Near(hint) => {
                                format!("{both}, as far from {} the one as the other", place(&hint))
                            }
                            _ => both,
                        }
                    }
                },
                format!("choose one, as in \"near\": {{ \"{name}\": {first} }}"),
            )
        }
        DrawError::NoClosure { pin, least } => {
            let name = &scene.mechanism.point(*pin).name;
            let miss = if least.is_finite() {
                format!("{} {} are missing at {name}", short(least / unit.si), unit.symbol)
            } else {
                format!("the dyads around {name} never meet")
            };
            (
                Subject::Point(*pin),
                format!("cannot be assembled: {miss} in the best position"),
                "change the dimensions or the input".to_owned(),
            )
        }
        DrawError::NotPlaced { point } => {
            let name = &scene.mechanism.point(*point).name;
            let what = match scene.mechanism.rolls.is_empty() {
                true => format!("nothing that the scene says leads to the place of {name}"),
                false => format!("rolling does not say where {name} stands"),
            };
            (
                Subject::Point(*point),
                format!("ambiguous: {what}"),
                format!("say it, as in \"placed\": {{ \"{name}\": [0, 0] }}"),
            )
        }
        DrawError::NoAngle { input } => {
            let driven = match scene.mechanism.inputs[*input] {
                Input::Angle { link, .. } | Input::Speed { link, .. } => {
                    format!("link {}", scene.mechanism.link(link).number)
                }
                Input::Slide { .. } => "a slide".to_owned(),
            };
            (
                Subject::Input(*input),
                format!("ambiguous: {driven} is driven, and nothing says at which angle it stands"),
                "say it in the input, as in \"angle\": 0: the angle of the line between the link's first two joints; of a \
                 link of one joint that of its own x-axis, which lies along the guide on which it rides"
                    .to_owned(),
            )
        }
        DrawError::ComesApart { roll, how } => (
            Subject::Roll(*roll),
            scene.mechanism.say_parts(*roll, &rate_of(*how, scene)),
            "join their centres by a link, or take an input or a pair away: then the contact holds them"
                .to_owned(),
        ),
        DrawError::TurnedRound { slide, how } => {
            let pair = scene.mechanism.slides[*slide];
            let number = |link: LinkId| scene.mechanism.link(link).number;
            let guide = number(pair.guide.link);
            let (what, mend) = match (how, pair.rider) {
                (Round::Ride, Rider::Link { link, .. }) => (
                    format!(
                        "link {} stands turned by half a turn against the guide on link {guide} by which it slides",
                        number(link)
                    ),
                    "correct `turned` of this pair or of the other that holds it, by half a turn, or the places",
                ),
                _ => (
                    format!("the guide of link {guide} leads away from what rides on it"),
                    "the x-axis of a link of one joint points to its rider: turn the guide round, or change the sign of `at`",
                ),
            };
            (Subject::Slide(*slide), format!("cannot be assembled: {what}"), mend.to_owned())
        }
        DrawError::Unplaced { point, why } => {
            let name = &scene.mechanism.point(*point).name;
            let stated = scene.mechanism.statement_of(*point);
            let loci =
                stated.map(|stated| stated.loci.map(|locus| locus_in_words(scene, &locus)).join(" and "));
            let loci = loci.unwrap_or_default();
            match why {
                Unplaced::Apart => (
                    Subject::Place(*point),
                    format!("{name} cannot be placed: {loci} do not meet"),
                    "correct one of the two".to_owned(),
                ),
                Unplaced::Touches => (
                    Subject::Place(*point),
                    format!("{name} cannot be placed: {loci} only touch or run side by side"),
                    "state something that crosses, from another point".to_owned(),
                ),
                Unplaced::Beside { by } => (
                    Subject::Place(*point),
                    format!(
                        "{name} is stated {} {} beside {}",
                        short(by / unit.si),
                        unit.symbol,
                        match stated.map(|stated| stated.standing) {
                            Some(Standing::Onto(locus)) => {
                                format!(
                                    "{}, on which its links and guides hold it",
                                    locus_in_words(scene, &locus)
                                )
                            }
                            _ => "where its links and guides put it".to_owned(),
                        }
                    ),
                    format!("correct what is stated of {name}, or the dimensions of its links"),
                ),
            }
        }
        DrawError::Missing(what) => (
            match *what {
                Missing::Place(point) | Missing::Image(_, point) => Subject::Point(point),
                Missing::Sliding(slide) => Subject::Slide(slide),
                Missing::OwnPoint(link, _)
                | Missing::Pose(link)
                | Missing::Joint(link)
                | Missing::StraightGuide(link)
                | Missing::Rate(_, link)
                | Missing::Turning(link) => Subject::Link(link),
                Missing::Input(input) => Subject::Input(input),
                Missing::Sought
                | Missing::Work(_)
                | Missing::Aim(_)
                | Missing::Sense(_)
                | Missing::Side(_)
                | Missing::Balance => Subject::Scene,
            },
            format!("cannot be drawn: {}", what.say(&scene.mechanism)),
            "say it by a dimension, or place the points that it follows from".to_owned(),
        ),
        DrawError::NoConstruction { links } => {
            let names: Vec<String> =
                links.iter().map(|&l| scene.mechanism.link(l).number.to_string()).collect();
            (
                links.first().map_or(Subject::Scene, |&l| Subject::Link(l)),
                format!("no graphical construction is known for the group of links {}", names.join(", ")),
                "`linkgram structure` shows how the mechanism falls apart".to_owned(),
            )
        }
    }
}

/// A locus for a message: `the circle of 12.5 cm about O3`.
fn locus_in_words(scene: &Scene, locus: &Locus) -> String {
    let name = |point: PointId| scene.mechanism.point(point).name.as_str();
    let unit = &scene.units.length;
    let length = |metres: f64| format!("{} {}", short(metres / unit.si), unit.symbol);
    let angle = |radians: f64| {
        let unit = &scene.units.angle;
        format!("{} {}", short(radians / unit.si), unit.symbol)
    };
    match *locus {
        Locus::Circle { centre, radius } => {
            format!("the circle of {} about {}", length(radius.value), name(centre))
        }
        Locus::Ray { from, direction } => {
            format!("the ray from {} at {}", name(from), angle(direction.value))
        }
        Locus::Square { through, to: [p, q] } => {
            format!("the line through {} square to {}{}", name(through), name(p), name(q))
        }
        Locus::Sees { ends: [p, q], angle: at } => {
            format!("the circle from which {}{} is seen at {}", name(p), name(q), angle(at.value))
        }
        Locus::On(Path::Straight { .. }) => "the line of its guide".to_owned(),
        Locus::On(Path::Arc { radius, .. }) => format!("the arc of radius {}", length(radius.value)),
    }
}

/// A number with two significant digits: an error.
#[cfg(feature = "cli")]
pub(crate) fn two_digits(x: f64) -> String {
    let text = format!("{x:.1e}");
    text.parse::<f64>().map_or(text, |rounded| format!("{rounded}"))
}

/// A number with so many significant digits, one at least; a power of ten where the zeros would be more than digits.
pub(crate) fn significant(x: f64, digits: usize) -> String {
    let text = format!("{x:.*e}", digits.saturating_sub(1));
    match text.parse::<f64>() {
        Ok(rounded) if rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs()) => format!("{rounded}"),
        Ok(rounded) => format!("{rounded:e}"),
        Err(_) => text,
    }
}

/// An answer for people, in a unit.
pub(crate) fn describe_in(unit: &Unit, answer: &Answer) -> String {
    match answer {
        Answer::Scalar { value, .. } => {
            format!("{} {}", short(value / unit.si), unit.symbol)
        }
        Answer::Vector { value, .. } => {
            let [x, y] = value.map(|v| v / unit.si);
            format!("({}, {}) = {} {}", short(x), short(y), short(libm::hypot(x, y)), unit.symbol)
        }
        Answer::AtInfinity { direction, .. } => {
            let degrees = libm::atan2(direction[1], direction[0]).to_degrees();
            format!("at infinity, along {} deg", short(degrees))
        }
        Answer::Indeterminate(why) => format!("indeterminate: {why}"),
    }
}
