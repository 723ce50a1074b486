//! What a sheet shows is what the independent solver says, or it is not drawn: the check of `draw` itself.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

use linkgram::check::{Unconfirmed, confirm};
use linkgram::graphical::auxiliary::AuxiliaryAct;
use linkgram::graphical::construction::{Act, Calculation, Label, TransferAct};
use linkgram::mechanism::PointId;
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::scale;
use linkgram::solve::{Solved, solve};

fn whole(scene: &Scene) -> Solved {
    solve(scene, Extent::WholeSkeleton, scale::for_scene).unwrap()
}

#[test]
fn everything_that_the_examples_and_the_catalogue_show_is_confirmed() {
    let examples = common::example_paths().into_iter();
    let mut scenes: Vec<(String, String)> =
        examples.map(|path| (path.display().to_string(), std::fs::read_to_string(path).unwrap())).collect();
    let kinds = linkgram::catalogue::KINDS.iter();
    scenes.extend(kinds.map(|entry| (entry.name.to_owned(), entry.scene.to_owned())));
    let mut wrong = Vec::new();
    let mut shown = 0;
    for (name, text) in &scenes {
        let Ok(scene) = linkgram::scene::read(text, name) else { continue };
        for (extent, scales) in [
            (Extent::WholeSkeleton, scale::for_scene as fn(&_, _) -> _),
            (Extent::WholeSkeleton, scale::for_question),
            (Extent::AllCentres, scale::for_scene),
        ] {
            let Ok(solved) = solve(&scene, extent, scales) else { continue };
            shown += solved.solution.shown.len();
            if let Err(why) = confirm(&scene, &solved) {
                wrong.push(format!("{name} {extent:?}: {why}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {} scenes:\n{}", wrong.len(), scenes.len(), wrong.join("\n"));
    assert!(shown > 20 * scenes.len(), "a sheet shows more than was asked: {shown}");
}

/// The name of the first quantity that is not confirmed.
fn named(scene: &Scene, solved: &Solved) -> String {
    match confirm(scene, solved).unwrap_err() {
        Unconfirmed::Number { first, .. } => first.name,
        other => panic!("{other}"),
    }
}

#[test]
fn ink_that_is_off_by_a_millionth_of_a_millimetre_is_found_whatever_it_is() {
    let scene = common::example("s000-ch3a-1");
    let solved = whole(&scene);
    confirm(&scene, &solved).unwrap();
    let m = &scene.mechanism;
    for (order, polygon) in solved.solution.construction.diagrams.iter().enumerate() {
        for (index, vector) in polygon.vectors.iter().enumerate() {
            let mut off = solved.clone();
            let construction = &mut off.solution.construction;
            construction.diagrams[order].vectors[index].to[0] += 1e-6;
            assert_eq!(named(&scene, &off), vector.quantity.name(m), "a vector");
        }
        for (index, image) in polygon.images.iter().enumerate() {
            let Label::Image { point, .. } = image.label else { continue };
            let mut off = solved.clone();
            let construction = &mut off.solution.construction;
            construction.diagrams[order].images[index].at[1] -= 1e-6;
            let letter = if order == 0 { "v" } else { "a" };
            assert_eq!(named(&scene, &off), format!("{letter}({})", m.point(point).name), "an image");
        }
    }
    for step in 0..solved.solution.construction.steps.len() {
        for act in 0..solved.solution.construction.steps[step].acts.len() {
            let mut off = solved.clone();
            let expected = match &mut off.solution.construction.steps[step].acts[act] {
                Act::Calculate(Calculation::Omega { link, value, .. }) => {
                    *value *= 1.0 + 1e-9;
                    format!("omega({})", m.link(*link).number)
                }
                Act::Calculate(Calculation::Alpha { link, value, .. }) => {
                    *value = -*value;
                    format!("alpha({})", m.link(*link).number)
                }
                _ => continue,
            };
            assert_eq!(named(&scene, &off), expected, "a calculation");
        }
    }
}

#[test]
fn another_length_is_found_and_another_assembly_is_told_from_it() {
    let text = common::example_text("s000-ch3a-1");
    let solved = whole(&common::read(&text));
    let longer = text.replace("[\"A\", \"B\"], \"length\": 45", "[\"A\", \"B\"], \"length\": 45.000001");
    assert_ne!(longer, text);
    let longer = common::read(&longer);
    let error = confirm(&longer, &solved).unwrap_err();
    let said = error.to_string();
    assert!(said.contains(" cm/s apart, where the bounds allow "), "{said}");
    let crank = with_a_dyad(30.0, 40.0, r#""v(B)""#);
    let solved = solve(&crank, Extent::Asked, scale::for_scene).unwrap();
    let other = common::read(&crank.source.text().replace("[50, 0]", "[-30, 0]"));
    match confirm(&other, &solved).unwrap_err() {
        Unconfirmed::Assembly(elsewhere) => assert_eq!(elsewhere.name, "x(B)"),
        other => panic!("{other}"),
    }
}

/// A slider-crank, and a dyad of links 5 and 6 on its crank pin for which nobody asks.
fn with_a_dyad(first: f64, second: f64, find: &str) -> Scene {
    common::read(&format!(
        r#"{{ "units": {{ "length": "cm" }}, "fixed": {{ "O2": [0, 0], "O6": [30, 40] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 15 }}, "3": {{ "joins": ["A", "B"], "length": 45 }},
            "5": {{ "joins": ["A", "E"], "length": {first} }}, "6": {{ "joins": ["E", "O6"], "length": {second} }} }},
        "slides": [{{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }}],
        "near": {{ "B": [50, 0] }},
        "input": {{ "link": 2, "angle": 30, "omega": "10 rad/s cw" }}, "find": [{find}] }}"#
    ))
}

#[test]
fn what_nobody_asks_for_may_be_impossible_or_ambiguous() {
    let (_, alone) = {
        let scene = with_a_dyad(30.0, 40.0, r#""v(B)", "omega(3)""#);
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        (scene, solved.solution.construction.answers)
    };
    // Too short to meet; two places and no hint.
    for (lengths, asked) in [([3.0, 4.0], "cannot be assembled"), ([30.0, 40.0], "ambiguous")] {
        let scene = with_a_dyad(lengths[0], lengths[1], r#""v(B)", "omega(3)""#);
        let numbers = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        assert_eq!(numbers.solution.construction.answers, alone);
        let state = linkgram::solve::solve_analytically(&scene);
        let agreement = linkgram::check::agreement(&scene, &numbers, &state);
        assert!(agreement.ok() && agreement.compared.iter().all(|c| c.indeterminate().is_none()));
        for kind in linkgram::drawing::Kind::ALL {
            let wish = linkgram::drawing::Wish { kind, ..Default::default() };
            let figure =
                linkgram::drawing::figure(&scene, &wish).unwrap_or_else(|e| panic!("{}", e.told(&scene)));
            assert!(figure.description.contains("Links 5, 6 are not drawn"), "{}", figure.description);
            let touching = linkgram::sheet::overlap::overlaps(&figure);
            assert!(touching.is_empty(), "{touching:#?}");
        }
        let wanted = with_a_dyad(lengths[0], lengths[1], r#""v(B)", "v(E)""#);
        let refused = linkgram::drawing::figure(&wanted, &linkgram::drawing::Wish::default()).unwrap_err();
        assert!(refused.told(&wanted).contains(asked), "{}", refused.told(&wanted));
    }
}

#[test]
fn a_note_stands_on_every_page_and_touches_nothing() {
    for stem in ["s000-ch3a-1", "eight-link"] {
        let scene = common::example(stem);
        let solved = whole(&scene);
        for language in linkgram::sheet::Language::ALL {
            let construction = &solved.solution.construction;
            let sheet = linkgram::sheet::solution(&scene, construction, language);
            let single = linkgram::sheet::single(&scene, construction, "velocity", language).unwrap();
            for figure in [sheet, single] {
                let height = figure.height;
                let noted = linkgram::sheet::unconfirmed(figure, Some("v(B)"), "by 1 cm/s", language);
                let noted = linkgram::sheet::left_out(noted, &[5, 6], "too short", language);
                assert!(noted.description.contains("v(B)"), "{}", noted.description);
                let touching = linkgram::sheet::overlap::overlaps(&noted);
                assert!(touching.is_empty(), "{stem} {language:?}: {touching:#?}");
                let svg = linkgram::render::svg::write(&noted);
                assert!(
                    svg.contains("data-unconfirmed=\"by 1 cm/s\"")
                        && svg.contains("data-left-out=\"too short\"")
                );
                let pages = linkgram::render::pages::of(&noted);
                for page in &pages {
                    let ink = page.group.bounds().unwrap();
                    assert!(
                        ink.y0 >= page.top && ink.y1 <= page.top + page.height,
                        "{stem} {language:?}: {ink:?}"
                    );
                }
                assert!(pages.len() > 1 || noted.height > height, "there is room for the note");
            }
        }
    }
}

/// A parallelogram of awkward numbers: its coupler only translates, which arithmetic finds to a rounding.
fn parallelogram() -> Scene {
    common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0.1, 0.7], "O4": [70.3, 20.9] },
        "links": { "2": { "joins": ["O2", "A"], "length": 31.7 }, "4": { "joins": ["O4", "B"], "length": 31.7 },
            "3": { "joins": ["A", "B", "C"], "shape": { "A": [0, 0], "B": [70.2, 20.2], "C": [13.1, 44.7] } } },
        "near": { "B": [92.8, 43.3], "C": [35.6, 67.8] },
        "input": { "link": 2, "angle": 45.3, "omega": "7.3 rad/s ccw", "alpha": "1.9 rad/s^2 cw" },
        "find": ["omega(3)", "alpha(3)", "v(B/A)", "a(B/A)", "v(C)"] }"#,
    )
}

#[test]
fn what_the_bound_cannot_tell_from_zero_is_zero_everywhere() {
    let scene = parallelogram();
    let solved = whole(&scene);
    let construction = &solved.solution.construction;
    let noise = construction.answers[..4].iter().filter(|reading| {
        let answer = &reading.answer;
        assert!(answer.may_be_zero(), "{answer:?}");
        !matches!(answer, linkgram::mechanism::quantity::Answer::Scalar { value: 0.0, .. })
    });
    assert!(noise.count() > 0, "no rounding to be hidden");
    for act in construction.steps.iter().flat_map(|step| &step.acts) {
        match act {
            Act::Calculate(
                Calculation::Omega { link, value, .. } | Calculation::Alpha { link, value, .. },
            ) if scene.mechanism.link(*link).number == 3 => {
                assert_eq!(*value, 0.0, "{act:?}");
            }
            // Of two points of the coupler, whether or not a vector shows them: it does not turn.
            Act::Calculate(Calculation::Normal { ends, speed, .. })
                if ends.iter().all(|end| !scene.mechanism.is_fixed(*end)) =>
            {
                assert_eq!(*speed, 0.0, "{act:?}");
            }
            _ => {}
        }
    }
    for polygon in &construction.diagrams {
        for vector in &polygon.vectors {
            let name = vector.quantity.name(&scene.mechanism);
            if name.contains("(B/A)") {
                assert!(vector.as_point && vector.is_zero, "{name}");
            }
        }
    }
    let wish = linkgram::drawing::Wish::default();
    let svg = linkgram::render::svg::write(&linkgram::drawing::figure(&scene, &wish).unwrap());
    for group in svg.split("<g ").filter(|group| group.starts_with("class=\"rotation")) {
        assert!(!group.contains("(3)"), "{group}");
    }
    assert!(!svg.contains("10<tspan"), "no power of ten is printed");
    assert!(!svg.contains("too short to read"), "noise is read");
}

/// Constructions on the skeleton, velocities carried over by centres and other positions are confirmed as they are,
/// and found where one of their numbers is off by a millionth.
#[test]
fn what_stands_beside_the_polygons_is_confirmed() {
    let mut numbers = 0;
    for name in [
        "constructions/klein",
        "constructions/inflection",
        "centres/four-bar",
        "centres/whitworth",
        "other-positions",
    ] {
        let scene = common::example(name);
        let wanted =
            scene.sheet.figures.iter().filter_map(|name| linkgram::sheet::auxiliary(name, &scene).unwrap());
        let auxiliary: Vec<_> = wanted.collect();
        let settings = linkgram::solve::Settings::default();
        let solved = linkgram::solve::solve_with(
            &scene,
            Extent::WholeSkeleton,
            &auxiliary,
            settings,
            scale::for_scene,
        );
        let solved = solved.unwrap();
        confirm(&scene, &solved).unwrap_or_else(|why| panic!("{name}: {why}"));
        let found = |off: &Solved, what: &str| assert!(confirm(&scene, off).is_err(), "{name}: {what}");
        let construction = &solved.solution.construction;
        for (at, drawing) in construction.auxiliary.iter().enumerate() {
            for act in 0..drawing.acts.len() {
                let mut off = solved.clone();
                match &mut off.solution.construction.auxiliary[at].acts[act] {
                    AuxiliaryAct::ReadImage { mm, .. } if mm.abs() > 1.0 => *mm *= 1.0 + 1e-6,
                    AuxiliaryAct::InflectionCircle { diameter, .. } => *diameter *= 1.0 + 1e-6,
                    _ => continue,
                }
                numbers += 1;
                found(&off, "a construction on the skeleton");
            }
        }
        for (at, transfer) in construction.circle.iter().flat_map(|circle| &circle.transfers).enumerate() {
            for act in 0..transfer.acts.len() {
                let mut off = solved.clone();
                let circle = off.solution.construction.circle.as_mut().unwrap();
                match &mut circle.transfers[at].acts[act] {
                    TransferAct::Ratio { omegas, .. } => omegas[1] *= 1.0 + 1e-6,
                    TransferAct::Parallel { speed, .. }
                    | TransferAct::Gauge { speed, .. }
                    | TransferAct::AboutPole { speed, .. } => *speed *= 1.0 + 1e-6,
                    TransferAct::Omega { omega, .. } => *omega *= 1.0 + 1e-6,
                    _ => continue,
                }
                numbers += 1;
                found(&off, "a velocity carried over");
            }
        }
        for (at, other) in construction.others.iter().enumerate() {
            for point in (0..other.places.len()).filter(|&p| !scene.mechanism.is_fixed(PointId(p))) {
                let mut off = solved.clone();
                let Some(place) = &mut off.solution.construction.others[at].places[point] else { continue };
                place[0] += 1e-7;
                numbers += 1;
                found(&off, "another position");
            }
        }
    }
    assert!(numbers > 20, "{numbers}");
}

/// Where the origin of a link's own coordinates lies is nobody's business: a million lengths away the mechanism is the same,
/// and both solvers say so.
#[test]
fn own_coordinates_far_from_their_origin() {
    use linkgram::mechanism::quantity::Answer;
    let scene = |link: &str| {
        common::read(&format!(
            r#"{{ "units": {{ "length": "cm" }}, "fixed": {{ "O2": [0, 0], "O4": [20, 0] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": 7 }}, "3": {{ "joins": ["A", "B"], {link} }},
                            "4": {{ "joins": ["O4", "B"], "length": 13 }} }},
                 "near": {{ "B": [19, 13] }}, "input": {{ "link": 2, "angle": 60, "omega": 10 }},
                 "find": ["v(B)", "a(B)", "omega(3)", "alpha(4)"] }}"#
        ))
    };
    let answers = |scene: &Scene| {
        let solved = whole(scene);
        confirm(scene, &solved).unwrap();
        let readings = solved.solution.construction.answers.into_iter();
        readings.map(|reading| reading.answer).collect::<Vec<_>>()
    };
    let near = answers(&scene(r#""length": 17"#));
    for far in [
        r#""line": [1e6, 1000017]"#,
        r#""line": [-1e9, -999999983]"#,
        r#""shape": { "A": [4e7, 3e7], "B": [40000008, 30000015] }"#,
    ] {
        for (one, other) in near.iter().zip(answers(&scene(far))) {
            let (apart, within) = match (one, &other) {
                (Answer::Scalar { value: a, bound: e }, Answer::Scalar { value: b, bound: f }) => {
                    ((a - b).abs(), e + f)
                }
                (Answer::Vector { value: a, bound: e }, Answer::Vector { value: b, bound: f }) => {
                    (libm::hypot(a[0] - b[0], a[1] - b[1]), e + f)
                }
                _ => panic!("{far}: {other:?}"),
            };
            assert!(apart <= within, "{far}: {apart:e} apart, bounds {within:e}");
        }
    }
}

/// Aⁿ of 0.5 mm/s² between images a hundred millimetres from the pole: its ink is no better than their places are written.
#[test]
fn a_short_vector_far_from_the_pole_is_confirmed() {
    let text = r#"{ "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O4": [160, 0], "O6": [320, 20], "O8": [470, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 150 },
            "4": { "joins": ["O4", "B", "C"], "sides": [100, 60, 120] }, "5": { "joins": ["C", "D"], "length": 170 },
            "6": { "joins": ["O6", "D", "E"], "line": [0, 90, 130] }, "7": { "joins": ["E", "F"], "length": 150 },
            "8": { "joins": ["O8", "F", "G"], "line": [0, 100, 150] }, "9": { "joins": ["G", "H"], "length": 120 } },
        "slides": [ { "pin": "H", "block": 10, "on": { "link": 1, "through": [0, 230] } } ],
        "near": { "B": [150, 100], "C": [200, 120], "D": [320, 110], "E": [320, 150], "F": [470, 100], "G": [470, 150],
            "H": [560, 230] },
        "input": { "link": 2, "angle": 30, "omega": "20 rad/s cw", "alpha": "100 rad/s^2 ccw" } }"#;
    let scene = common::read(text);
    confirm(&scene, &whole(&scene)).unwrap();
}

/// A bar that is driven slides over a pin of a crank, with a joint of its own on a guide of the frame. What its turning gives
/// that joint is ω times the distance from the point of the bar *under* the pin, which is not the pin's velocity against the
/// joint; and the sheet that called it so was refused.
#[test]
fn what_a_bar_turns_about_the_point_under_a_pin_is_no_velocity_against_the_pin() {
    let omega = 3.0;
    let (mut scenes, mut laid_off) = (0, 0);
    for (block, standing) in [(false, false), (true, true), (true, false), (false, true)] {
        // The angle of the bar, its distance from the pin, and how far along the bar its joint is from the pin's foot.
        for [angle, aside, along] in
            [[0.0, 25.0, 0.0], [0.0, 25.0, 7.0], [31.7, 23.9, 0.0], [-58.3, 11.3, 13.7]]
        {
            let (sin, cos) = libm::sincos(f64::to_radians(angle));
            let pin = [18.0, 24.0];
            let joint = [pin[0] - along * cos + aside * sin, pin[1] - along * sin - aside * cos];
            let blocks = if block { [r#", "block": 7"#, r#", "block": 8"#] } else { ["", ""] };
            let (fixed, crank, turns, name) = if standing {
                (r#", "I": [18, 24]"#, "", "", "v(G@6/I@6)")
            } else {
                (
                    "",
                    r#""2": { "joins": ["O2", "I"], "length": 30 },"#,
                    r#"{ "link": 2, "angle": 53.13010235415598, "omega": 2 },"#,
                    "v(G@6/I@6)",
                )
            };
            let text = format!(
                r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] {fixed} }},
                "links": {{ {crank} "6": {{ "joins": ["G", "K"], "length": 50 }} }},
                "slides": [ {{ "pin": "I" {}, "on": {{ "link": 6, "through": "G", "offset": {aside} }} }},
                            {{ "pin": "G" {}, "on": {{ "link": 1, "through": [{}, {}], "angle": 70 }} }} ],
                "near": {{ "G": [{}, {}] }},
                "inputs": [ {turns} {{ "link": 6, "angle": {angle}, "omega": {omega}, "alpha": 1 }} ] }}"#,
                blocks[0], blocks[1], joint[0], joint[1], joint[0], joint[1]
            );
            let scene = linkgram::scene::read(&text, "bar.json").unwrap_or_else(|e| panic!("{e}\n{text}"));
            let solved = whole(&scene);
            if let Err(why) = confirm(&scene, &solved) {
                panic!("{why}\n{text}");
            }
            let polygon = &solved.solution.construction.diagrams[0];
            let named =
                |v: &&linkgram::graphical::construction::Vector| v.quantity.name(&scene.mechanism) == name;
            for vector in polygon.vectors.iter().filter(named) {
                let [dx, dy] = [0, 1].map(|axis| (vector.to[axis] - vector.from[axis]) * polygon.si_per_mm);
                let apart = [joint[0] - pin[0], joint[1] - pin[1]].map(|mm| mm / 1000.0);
                assert!(
                    (dx + omega * apart[1]).abs() < 1e-12 && (dy - omega * apart[0]).abs() < 1e-12,
                    "{dx} {dy}"
                );
                laid_off += 1;
            }
            scenes += 1;
        }
    }
    assert!(scenes == 16 && laid_off > 8, "{scenes} {laid_off}");
}
