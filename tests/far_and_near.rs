//! What lies far away does not decide how large the rest is drawn, what lies near is told apart, and what is asked for comes on
//! the paper that was asked for.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use kurbo::{Point, Rect};
use linkgram::drawing::{self, Kind, Wish};
use linkgram::scene::Scene;
use linkgram::sheet::Language;
use linkgram::sheet::figure::{Figure, Group, Node, Shape};
use serde_json::{Value, json};

use crate::common;
use crate::legibility::{data, has, marks, number, sentences, within};
use crate::sixty_sheets::{four_bars, joint, panels};

fn plain(text: &str) -> String {
    text.replace(['\u{a0}', '\u{2009}'], " ")
}

fn drawn(scene: &Scene, wish: &Wish) -> Figure {
    drawing::figure(scene, wish).unwrap_or_else(|why| panic!("{}", why.told(scene)))
}

fn told(figure: &Figure) -> Vec<String> {
    sentences(figure).iter().map(|line| plain(line)).collect()
}

/// Width and height of its pages.
fn page_of(figure: &Figure) -> [f64; 2] {
    [figure.width, figure.height / figure.pages().len().max(1) as f64]
}

fn is_paper(figure: &Figure, paper: [f64; 2]) -> bool {
    page_of(figure).iter().zip(paper).all(|(own, asked)| (own - asked).abs() < 1e-6)
}

/// Four-bars whose cranks are parallel within a few degrees, so that the pole of the rod is far away, and some others.
fn with_far_poles() -> Vec<Value> {
    let mut all = Vec::new();
    for (crank, rod, rocker, pivot, angle) in [
        (56.1, 120.0, 66.0, [124.5, 0.0], 80.0),
        (77.8, 130.2, 80.9, [135.8, 0.0], 256.0),
        (61.1, 154.2, 124.0, [119.3, 0.0], 315.0),
        (43.7, 120.1, 105.8, [124.8, 0.0], 232.0),
        (54.0, 94.3, 55.2, [96.7, 0.0], 124.0),
    ] {
        let (sin, cos) = f64::to_radians(angle).sin_cos();
        let pin: [f64; 2] = [crank * cos, crank * sin];
        let far: [f64; 2] = [pivot[0] - pin[0], pivot[1] - pin[1]];
        let apart = far[0].hypot(far[1]);
        let along = (rod * rod - rocker * rocker + apart * apart) / (2.0 * apart);
        let half = f64::max(rod * rod - along * along, 0.0).sqrt();
        let unit = [far[0] / apart, far[1] / apart];
        let end = [pin[0] + along * unit[0] - half * unit[1], pin[1] + along * unit[1] + half * unit[0]];
        all.push(json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": pivot },
            "links": { "2": { "joins": ["O2", "A"], "length": crank }, "3": { "joins": ["A", "B"], "length": rod },
                       "4": { "joins": ["O4", "B"], "length": rocker } },
            "near": { "B": end }, "input": { "link": 2, "angle": angle, "omega": "10 rad/s ccw" }
        }));
    }
    all.into_iter().chain(four_bars(8)).collect()
}

/// Velocities carried over beside the polygon: the skeleton is no smaller for arrows and centres that lie far away, and no paper
/// grows.
#[test]
fn a_far_centre_leaves_the_skeleton_its_size() {
    for (place, mut scene) in with_far_poles().into_iter().enumerate() {
        let method = ["link-to-link", "gauge-line", "line-of-centres"][place % 3];
        scene["find"] = json!(["v(B)", "omega(3)", "omega(4)", { "name": "v(B)", "method": method }]);
        let scene = common::read(&scene.to_string());
        let figure = drawn(&scene, &Wish::default());
        assert!(is_paper(&figure, [210.0, 297.0]), "{place}: {:?}", page_of(&figure));
        for class in ["skeleton", "transfer"] {
            let panel = panels(&figure, class)[0];
            let places = ["O2", "A", "B", "O4"].map(|name| joint(panel, name));
            let span = places
                .iter()
                .skip(1)
                .fold(Rect::from_points(places[0], places[0]), |all, at| all.union_pt(*at));
            assert!(span.width().max(span.height()) > 50.0, "{place}, {method}: {class} {span:?}");
        }
    }
}

/// Whatever the paper, its pages have its size where no scale is stated.
#[test]
fn the_paper_is_what_was_asked_for() {
    let papers = [("A4", [210.0, 297.0]), ("A5", [148.0, 210.0]), ("A3 landscape", [420.0, 297.0])];
    for (place, mut scene) in with_far_poles().into_iter().enumerate() {
        let (paper, size) = papers[place % papers.len()];
        scene["find"] = json!(["I(1,3)", "I(2,4)", "v(B)", { "name": "omega(3)", "method": "gauge-line" }]);
        scene["sheet"] = json!({ "paper": paper });
        let figure = drawn(&common::read(&scene.to_string()), &Wish::default());
        assert!(is_paper(&figure, size), "{place}, {paper}: {:?}", page_of(&figure));
    }
    for name in ["centres/whitworth", "centres/four-bar", "centres/gear-linkage", "s000-ch3b-1"] {
        let figure = drawn(&common::example(name), &Wish::default());
        assert!(is_paper(&figure, [210.0, 297.0]), "{name}: {:?}", page_of(&figure));
    }
}

/// A larger paper has larger polygons, as far as their form lets it.
#[test]
fn an_acceleration_diagram_grows_with_its_paper() {
    let (mut grown, mut all) = (0, 0);
    for mut scene in four_bars(8) {
        scene["find"] = json!(["omega(3)", "alpha(3)", "a(B)"]);
        let mut size = |paper: &str| {
            scene["sheet"] = json!({ "paper": paper });
            let figure = drawn(&common::read(&scene.to_string()), &Wish::default());
            let bounds = panels(&figure, "acceleration")[0].bounds().unwrap();
            bounds.width().max(bounds.height())
        };
        let [small, large] = ["A4", "A3 landscape"].map(&mut size);
        assert!(large > 0.9 * small, "{small} on A4, {large} on A3");
        all += 1;
        grown += usize::from(large > 1.2 * small);
    }
    assert!(2 * grown > all, "{grown} of {all}");
}

/// The figures that a scene wishes come on pages of its paper, where they do not fit on one.
#[test]
fn many_figures_are_pages() {
    let mut scene = four_bars(1).remove(0);
    scene["find"] = json!(["omega(3)", "alpha(3)", "a(B)", "I(1,3)"]);
    scene["sheet"] = json!({ "figures": ["skeleton", "velocity", "acceleration", "inflection(3)", "centres", "results", "steps"] });
    let figure = drawn(&common::read(&scene.to_string()), &Wish::default());
    assert!(figure.pages().len() > 1 && is_paper(&figure, [210.0, 297.0]), "{:?}", page_of(&figure));
    for class in ["skeleton", "velocity", "acceleration", "construction-on-skeleton", "instant-centres"] {
        assert_eq!(panels(&figure, class).len(), 1, "{class}");
    }
    // Two that fit are still one small figure.
    scene["sheet"] = json!({ "figures": ["velocity", "results"] });
    let small = drawn(&common::read(&scene.to_string()), &Wish::default());
    assert!(small.height < 297.0 && small.pages().is_empty(), "{}", small.height);
}

/// What is measured on a construction is told by its own scale, also in the steps beside it.
#[test]
fn a_construction_is_measured_at_its_own_scale() {
    let mut compared = 0;
    for mut scene in
        [serde_json::from_str(&std::fs::read_to_string("examples/constructions/inflection.json").unwrap())
            .unwrap()]
        .into_iter()
        .chain(four_bars(10))
    {
        scene["find"] = json!(["omega(3)", "alpha(3)"]);
        scene["sheet"] = json!({ "figures": ["skeleton", "inflection(3)", "steps"] });
        scene.as_object_mut().unwrap().remove("published");
        let figure = drawn(&common::read(&scene.to_string()), &Wish::default());
        let panel = panels(&figure, "construction-on-skeleton")[0];
        let per_mm: f64 = data(panel, "si-per-mm").unwrap().parse().unwrap();
        for line in told(&figure) {
            let Some((_, rest)) = line.split_once("(13)W = ") else { continue };
            let Some((mm, half)) = number(rest).map(|(mm, half, _)| (mm, half)) else { continue };
            let Some((_, value)) = rest.split_once("that is ") else { continue };
            let (value, room, _) = number(value).unwrap();
            // In millimetres, as the scene has them.
            let by_scale = mm * per_mm * 1000.0;
            compared += 1;
            assert!((by_scale - value).abs() <= room + half * per_mm * 1000.0, "{line} at {per_mm} m/mm");
        }
    }
    assert!(compared > 2, "{compared}");
}

/// Centres that are not one and stand nearer to each other than three millimetres are named in a detail.
#[test]
fn centres_that_nearly_coincide_have_a_detail() {
    let six = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [120, 0], "O6": [126, 3] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 110 },
                   "4": { "joins": ["O4", "B"], "length": 70 }, "5": { "joins": ["B", "D"], "length": 90 },
                   "6": { "joins": ["O6", "D"], "length": 100 } },
        "near": { "B": [110, 70], "D": [200, 75] }, "input": { "link": 2, "angle": 80, "omega": "12 rad/s cw" },
        "find": ["I(1,3)", "I(1,5)", "I(2,4)", "I(2,6)", "I(4,6)", "I(3,5)", "I(2,5)", "I(3,6)"] }"#;
    let mut near = 0;
    for scene in [common::read(six), common::example("centres/whitworth")] {
        let figure = drawn(&scene, &Wish::default());
        let panel = panels(&figure, "instant-centres")[0];
        let all = within(panel);
        let details: Vec<String> = all
            .iter()
            .filter(|group| has(group, "detail"))
            .flat_map(|detail| within(detail))
            .filter_map(|group| data(group, "of").map(str::to_owned))
            .collect();
        let stands = |group: &&&Group| {
            marks(group).find_map(|mark| match mark.shape {
                Shape::Circle { centre, .. } => Some(centre),
                _ => None,
            })
        };
        let centres: Vec<(String, Point)> = all
            .iter()
            .filter(|group| has(group, "centre"))
            .filter_map(|group| Some((data(group, "centre")?.to_owned(), stands(&group)?)))
            .collect();
        for (place, (name, at)) in centres.iter().enumerate() {
            for (other, there) in &centres[place + 1..] {
                if at.distance(*there) < 3.0 {
                    near += 1;
                    for own in [name, other] {
                        assert!(details.contains(own), "{own} is in no detail: {details:?}");
                    }
                }
            }
        }
    }
    assert!(near > 1, "{near}");
}

/// A picture of the steps that has the circle about a spot has its detail, and the detail has nothing that the picture has not.
#[test]
fn the_pictures_of_steps_have_their_details() {
    let wish = Wish { kind: Kind::Steps, ..Wish::default() };
    let mut seen = 0;
    for name in ["s000-ch3b-12", "s000-ch4-7", "eight-link", "s000-ch4-1"] {
        let figure = drawn(&common::example(name), &wish);
        let pictures = within(&figure.root);
        let pictures = pictures.iter().filter(|group| has(group, "velocity") || has(group, "acceleration"));
        for picture in pictures {
            let inside = within(picture);
            let count = |class: &str| inside.iter().filter(|group| has(group, class)).count();
            let spots: usize = inside
                .iter()
                .filter(|group| has(group, "spots"))
                .flat_map(|own| within(own))
                .flat_map(marks)
                .count();
            seen += spots;
            assert_eq!(count("detail"), spots, "{name}");
            // Whatever arrow is drawn thick in a detail is drawn in the picture.
            assert!(count("detail-vector") <= count("vector"), "{name}");
        }
    }
    assert!(seen > 3, "{seen}");
}

/// A group of higher class that is tried tells by how much the trials miss: by proportion that is the printed rate.
#[test]
fn a_trial_tells_by_how_much_it_misses() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O6": [210, 0] },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B", "C"] }, "4": { "joins": ["B", "E"] },
                   "5": { "joins": ["C", "D"] }, "6": { "joins": ["O6", "E", "D"] } },
        "placed": { "A": [25, 43], "B": [70, 115], "C": [115, 60], "E": [160, 140], "D": [195, 95] },
        "input": { "link": 2, "omega": "15 rad/s ccw" }, "find": ["omega(6)", "alpha(6)"] }"#,
    );
    let lines = told(&drawn(&scene, &Wish::default()));
    let mut tried = [0.0; 2];
    let mut compared = 0;
    let signed = |text: &str| {
        let (value, half, rest) = number(text).unwrap();
        (if rest.trim_start().split([' ', '.', ';']).any(|word| word == "cw") { -value } else { value }, half)
    };
    for line in &lines {
        if let Some((first, second)) =
            line.split_once(" and with ").filter(|_| line.contains("trial polygons"))
        {
            tried = [first, second].map(|text| {
                let end = text.split(". ").next().unwrap().rsplit_once(" = ").unwrap().1;
                signed(end).0
            });
        }
        let Some((misses, rate)) = line.split_once("By proportion") else { continue };
        let misses = misses.split_once("miss by ").unwrap_or_else(|| panic!("{line}")).1;
        let (first, second) = misses.split_once(" and by ").unwrap();
        let [first, second] = [first, second].map(|text| number(text).unwrap().0);
        let second = if misses.contains("opposite") { -second } else { second };
        let (value, half) = signed(rate.split_once(" = ").unwrap().1.split(';').next().unwrap());
        let own = tried[0] + (tried[1] - tried[0]) * first / (first - second);
        compared += 1;
        assert!((own - value).abs() <= half * (1.0 + 1e-6), "{line}: {tried:?} gives {own}");
    }
    assert_eq!(compared, 2);
}

/// Some results are one table on one page, in whatever language.
#[test]
fn a_few_results_are_one_table() {
    let scene = common::example("other-positions");
    for language in [Language::English, Language::Arabic, Language::Persian] {
        let figure = drawn(&scene, &Wish { language: Some(language), ..Wish::default() });
        let tables = within(&figure.root).into_iter().filter(|group| has(group, "results")).count();
        assert_eq!(tables, 1, "{language:?}");
    }
}

/// Names stand on the side of their point: none is read across a vector that does not end in it, unless a leader ties it.
#[test]
fn no_name_stands_across_a_vector_from_its_point() {
    let (mut seen, mut across) = (0, Vec::new());
    for name in ["pairs/oldham", "pairs/reversed-yoke", "pairs/higher-group", "s000-ch4-9-c", "s002-8"] {
        let scene = common::example(name);
        let solved = drawing::figure(&scene, &Wish::default()).unwrap();
        for kind in ["velocity", "acceleration"] {
            for panel in panels(&solved, kind) {
                // A detail has points of its own.
                let mut bare = panel.clone();
                bare.children.retain(|node| !matches!(node, Node::Group(group) if has(group, "detail")));
                let all = within(&bare);
                let strokes: Vec<(Point, Point)> = all
                    .iter()
                    .filter(|group| has(group, "vector"))
                    .flat_map(|group| marks(group))
                    .filter_map(|mark| match mark.shape {
                        Shape::Line(from, to) if from.distance(to) > 3.0 => Some((from, to)),
                        _ => None,
                    })
                    .collect();
                let images: Vec<(&str, Point)> = all
                    .iter()
                    .filter(|group| has(group, "image"))
                    .filter_map(|group| {
                        let at = marks(group).find_map(|mark| match mark.shape {
                            Shape::Circle { centre, .. } => Some(centre),
                            _ => None,
                        });
                        Some((data(group, "point")?, at?))
                    })
                    .collect();
                for group in all.iter().filter(|group| has(group, "name")) {
                    let of = data(group, "of").unwrap_or_default();
                    let leads = marks(group).any(|mark| mark.class == "leader");
                    let text = group
                        .children
                        .iter()
                        .any(|node| matches!(node, Node::Text(text) if text.class == "label image-name"));
                    let point = images.iter().find(|(name, _)| of.split(' ').any(|own| own == *name));
                    let (Some((_, at)), false, true, Some(ink)) = (point, leads, text, group.bounds()) else {
                        continue;
                    };
                    seen += 1;
                    let foot = ink.center().lerp(*at, 0.9);
                    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p) > 0.0;
                    let crosses = |(a, b): &(Point, Point)| {
                        let c = ink.center();
                        let ends = a.distance(*at) < 1.0 || b.distance(*at) < 1.0;
                        !ends
                            && side(c, foot, *a) != side(c, foot, *b)
                            && side(*a, *b, c) != side(*a, *b, foot)
                    };
                    if strokes.iter().any(crosses) {
                        across.push(format!("{name}: {of}"));
                    }
                }
            }
        }
    }
    assert!(seen > 20, "{seen}");
    assert!(across.is_empty(), "{across:?}");
}
