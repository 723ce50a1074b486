//! What a lecturer signs: a block lies along its guide, a force stands where it acts, an arm has its dimension where it can be
//! seen, a result is the true one in its printed figures, and one thing has one name.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use kurbo::Point;
use linkgram::catalogue::KINDS;
use linkgram::drawing::{self, Kind, Wish};
use linkgram::mechanism::quantity::Answer;
use linkgram::scene::Scene;
use linkgram::sheet::figure::{Figure, Group, Node, Shape};
use linkgram::sweep::{EventKind, Sweep};

use crate::common;
use crate::common::plane::{Xy, cross, dot, long, minus, plus, times, unit};
use crate::legibility::{characters, data, has, marks, number, reckoned, rows_of, sentences, within};

fn drawn(scene: &Scene, figures: &[&str]) -> Figure {
    let figures = figures.iter().map(|name| (*name).to_owned()).collect();
    let wish = Wish { kind: Kind::Solution, figures, ..Wish::default() };
    drawing::figure(scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(scene)))
}

fn told(figure: &Figure) -> Vec<String> {
    sentences(figure).into_iter().map(|line| line.replace(['\u{a0}', '\u{2009}'], " ")).collect()
}

/// The straight strokes of a group's own marks.
fn lines(group: &Group) -> Vec<(Point, Point)> {
    let own = marks(group).filter_map(|mark| match mark.shape {
        Shape::Line(from, to) => Some((from, to)),
        _ => None,
    });
    own.collect()
}

/// A slider-crank whose guide is turned by so many degrees, loaded along it.
fn turned_guide(degrees: f64) -> Scene {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    common::read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 50 }}, "3": {{ "joins": ["A", "B"], "length": 160 }} }},
        "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2", "angle": {degrees} }} }} ],
        "near": {{ "B": [{}, {}] }}, "input": {{ "link": 2, "angle": {} }},
        "loads": [ {{ "name": "P", "on": 4, "force": 800, "direction": {} }} ], "find": ["T(2)", "F(1,4)"] }}"#,
        180.0 * cos,
        180.0 * sin,
        degrees + 50.0,
        degrees + 180.0
    ))
}

/// The longer side of the free body of a block, as the angle of a line on the page, degrees counter-clockwise.
fn lies_at(figure: &Figure) -> f64 {
    let within = within(&figure.root);
    let body = within.iter().find(|group| has(group, "free-body")).unwrap();
    let link = body.children.iter().find_map(|node| match node {
        Node::Group(group) if has(group, "link") => Some(group),
        _ => None,
    });
    let sides = marks(link.unwrap()).find_map(|mark| match &mark.shape {
        Shape::Polygon(corners) if corners.len() == 4 => {
            Some([corners[1] - corners[0], corners[2] - corners[1]])
        }
        _ => None,
    });
    let [one, other] = sides.unwrap();
    let side = if one.hypot() > other.hypot() { one } else { other };
    libm::atan2(-side.y, side.x).to_degrees().rem_euclid(180.0)
}

#[test]
fn the_free_body_of_a_block_lies_along_its_guide() {
    for degrees in [0.0, 30.0, 90.0, 145.0] {
        let lies = lies_at(&drawn(&turned_guide(degrees), &["body(4)"]));
        let off = (lies - degrees + 90.0).rem_euclid(180.0) - 90.0;
        assert!(off.abs() < 1e-6, "{lies} for {degrees}");
    }
    // On an arc about C it lies along the tangent: square to the radius from C to B.
    let arc = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "centre": [120, -150], "radius": 180 } } ],
        "near": { "B": [200, 10] }, "input": { "link": 2, "angle": 50 },
        "loads": [ { "name": "P", "on": 4, "force": 800, "direction": 180 } ], "find": ["T(2)", "F(1,4)", "x(B)"] }"#,
    );
    let state = linkgram::solve::solve_analytically(&arc).unwrap();
    let at = arc.mechanism.asked.iter().find(|asked| asked.name == "x(B)").unwrap();
    let Answer::Vector { value: [x, y], .. } = state.answer(&at.quantity) else { panic!("no place of B") };
    let tangent = libm::atan2(x - 0.120, -(y + 0.150)).to_degrees();
    let off = (lies_at(&drawn(&arc, &["body(4)"])) - tangent + 90.0).rem_euclid(180.0) - 90.0;
    assert!(off.abs() < 1e-6, "{off}");
}

/// A crank with its mass centre between its ends, and steady: its inertia force lies along it.
const STEADY: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [200, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 80 }, "3": { "joins": ["A", "B"], "length": 190 },
               "4": { "joins": ["O4", "B"], "length": 130 } },
    "near": { "B": [190, 130] }, "input": { "link": 2, "angle": 115, "omega": "20 rad/s ccw" }, "gravity": {},
    "masses": { "2": { "mass": 4, "at": [40, 0] }, "4": { "mass": 3, "at": [70, 0] } },
    "find": ["T(2)", "F(1,2)"] }"#;

/// An arrow of a free body by the name of its quantity.
fn arrow(figure: &Figure, quantity: &str) -> (Point, Point) {
    let within = within(&figure.root);
    let own = within.iter().find(|group| has(group, "applied") && data(group, "quantity") == Some(quantity));
    lines(own.unwrap_or_else(|| panic!("no {quantity}")))[0]
}

#[test]
fn a_force_along_a_link_stands_where_it_acts() {
    let scene = common::read(STEADY);
    for figure in ["body(2)", "loads"] {
        let figure = drawn(&scene, &[figure]);
        // Weight and inertia force act at G₂; both begin there.
        let (inertia, weight) = (arrow(&figure, "Fin(2)"), arrow(&figure, "W(2)"));
        assert!(inertia.0.distance(weight.0) < 1e-6, "{} mm off", inertia.0.distance(weight.0));
        // The stroke of the link gives way to it.
        for link in within(&figure.root).into_iter().filter(|group| has(group, "free-body")) {
            let strokes = within(link).into_iter().filter(|group| has(group, "link")).flat_map(lines);
            for (a, b) in strokes {
                let along = (b - a).normalize();
                let middle = inertia.0.midpoint(inertia.1);
                let reach = (middle - a).dot(along).clamp(0.0, a.distance(b));
                assert!(middle.distance(a + along * reach) > 2.0, "on the link");
            }
        }
    }
}

/// Every arm that is measured has its dimension line where it is seen: on no stroke of a link.
#[test]
fn every_measured_arm_is_dimensioned_beside_the_links() {
    let (mut seen, mut aside) = (0, 0);
    let examples = ["1", "2", "9", "16", "20", "21"].map(|number| format!("forces/s000-ch5-{number}"));
    let along_link = common::read(ALONG_LINK);
    let scenes = examples.iter().map(|name| common::example(name)).chain([along_link]);
    let kinds = KINDS.iter().filter(|kind| ["engine", "press"].contains(&kind.name));
    for scene in scenes.chain(kinds.map(|kind| common::read(kind.scene))) {
        let figure = drawn(&scene, &[]);
        for body in within(&figure.root).into_iter().filter(|group| has(group, "free-body")) {
            let groups = within(body);
            let of = |class: &'static str| groups.iter().filter(move |group| has(group, class)).copied();
            let links: Vec<(Point, Point)> = of("link").flat_map(lines).collect();
            for arm in of("arm") {
                let strokes = lines(arm);
                let (from, to) = strokes[0];
                seen += 1;
                aside += usize::from(strokes.len() > 2);
                for (a, b) in &links {
                    let along = (*b - *a).normalize();
                    let off = |p: Point| (p - *a).cross(along).abs();
                    let [start, end] = [from, to].map(|p| (p - *a).dot(along));
                    let shared = start.max(end).min(a.distance(*b)) - start.min(end).max(0.0);
                    let lies = off(from) < 1.0 && off(to) < 1.0 && shared > 2.0;
                    assert!(!lies, "a dimension line on a link");
                }
            }
        }
        // Each arm that is measured has its name in a drawing.
        let names: Vec<String> = within(&figure.root)
            .into_iter()
            .flat_map(|group| &group.children)
            .filter_map(|node| match node {
                Node::Text(text) if text.class == "label arm-name" => Some(characters(text).replace('_', "")),
                _ => None,
            })
            .collect();
        for line in told(&figure).iter().filter(|line| line.starts_with("Measured: x_")) {
            for part in line.trim_start_matches("Measured: ").split(", ") {
                let name = part.split(' ').next().unwrap().replace('_', "");
                // Lengths from point to point have their letters.
                if !name.starts_with('x') {
                    continue;
                }
                assert!(
                    names.iter().any(|own| own.split(['≈', '=', ' ']).any(|own| own == name)),
                    "{name}: {names:?}"
                );
            }
        }
    }
    assert!(seen > 30 && aside > 0, "{seen}, {aside} beside a link");
}

/// A lever with a force square to it: its arm is the lever.
const ALONG_LINK: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [200, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 70 }, "3": { "joins": ["A", "B"], "length": 190 },
               "4": { "joins": ["B", "O4", "C"], "line": [0, 120, 230] } },
    "near": { "B": [190, 120], "C": [210, -110] }, "input": { "link": 2, "angle": 75, "omega": 5 },
    "loads": [ { "name": "Q", "on": 4, "at": "C", "force": 300, "direction": { "from": "O4", "to": "C", "turned": 90 } } ],
    "find": ["T(2)", "F(1,4)"] }"#;

/// A four-bar in many positions: what its table prints is what the independent solver finds, in the figures that stand there.
#[test]
fn results_of_forces_are_true_to_their_last_figure() {
    let (mut rows, mut off) = (0, Vec::new());
    for place in 0..30 {
        let angle = 20.0 + 9.7 * f64::from(place);
        let scene = common::read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [180, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 62 }}, "3": {{ "joins": ["A", "B"], "length": 170 }},
                        "4": {{ "joins": ["O4", "B", "C"], "line": [0, 121, 193] }} }},
            "near": {{ "B": [160, 1000] }}, "input": {{ "link": 2, "angle": {angle} }},
            "loads": [ {{ "name": "Q", "on": 4, "at": "C", "force": "430 N", "direction": 10 }} ],
            "find": ["T(2)", "F(3,4)", "F(1,4)", "F(1,2)"] }}"#
        ));
        let state = linkgram::solve::solve_analytically(&scene).unwrap();
        let figure = drawn(&scene, &[]);
        let tables = within(&figure.root).into_iter().filter(|group| has(group, "results"));
        let cells: Vec<String> = tables
            .flat_map(|table| rows_of(table).into_iter().skip(1))
            .map(|row| characters(row[1]))
            .collect();
        assert_eq!(cells.len(), scene.mechanism.asked.len());
        for (asked, cell) in scene.mechanism.asked.iter().zip(cells) {
            let exact = match state.answer(&asked.quantity) {
                Answer::Scalar { value, .. } => value.abs(),
                Answer::Vector { value: [x, y], .. } => libm::hypot(x, y),
                other => panic!("{other:?}"),
            };
            let (shown, half, _) = number(&cell).unwrap();
            rows += 1;
            if (shown - exact / asked.unit.si).abs() > half * (1.0 + 1e-6) {
                off.push(format!("{angle} deg: {} {cell}, and it is {exact}", asked.name));
            }
        }
    }
    assert_eq!(rows, 120);
    // A reading of four figures may leave one.
    assert!(off.len() <= 1, "{off:#?}");
}

/// The end of a rod slides on a rocker: its velocity has one number, in its symbol and in its image, and that is the rod's.
#[test]
fn a_pin_on_a_moving_guide_has_one_number() {
    let scene = common::read(
        r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [30, 0], "O6": [48, 22] },
        "links": { "2": { "joins": ["O2", "A"], "length": 8 }, "3": { "joins": ["A", "B"], "length": 28 },
                   "4": { "joins": ["O4", "B", "C"], "line": [0, 18, 40] }, "6": { "joins": ["O6", "D"], "length": 22 } },
        "slides": [ { "pin": "D", "block": 5, "on": { "link": 4, "through": "O4", "toward": "C" } } ],
        "near": { "B": [30, 18], "D": [32, 28], "C": [32, 40] }, "input": { "link": 2, "angle": 40, "omega": -6 },
        "find": ["omega(6)", "v(D)", "v(D@4)", "slip(D/4)", "a(D)", "coriolis(D/4)"] }"#,
    );
    let lines = told(&drawn(&scene, &[]));
    let all = lines.join("\n").replace('_', "");
    assert!(all.contains("Read VD6 = od6"), "{all}");
    assert!(all.contains("AcD6D4") || all.contains("A^cD6D4"), "{all}");
    assert!(!all.contains("D5"), "{all}");
}

/// A pin on an arc of the frame and on a crank: no direction is parallel to an arc, and its parts have the pin's number.
#[test]
fn what_runs_along_an_arc_is_tangent_to_it() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] }, "links": { "2": { "joins": ["O2"] } },
        "slides": [ { "pin": "P", "block": 3, "on": { "link": 2, "through": "O2", "angle": 0 } },
                    { "pin": "P", "block": 4, "on": { "link": 1, "centre": [30, 20], "radius": 70 } } ],
        "near": { "P": [80, 60] }, "input": { "link": 2, "angle": 40, "omega": 4, "alpha": 6 },
        "find": ["v(P)", "a(P)", "slip(P/2)"] }"#,
    );
    let figure = drawn(&scene, &[]);
    let all = told(&figure).join("\n");
    assert!(all.contains("draw a line tangent to the guide of P"), "{all}");
    assert!(!all.contains("∥ guide of P (link 1)"), "{all}");
    let plain = all.replace(['_', '^'], "");
    assert!(plain.contains("AnP3 = V2P3 / R") || plain.contains("AnP3 = VP3² / R"), "{plain}");
}

/// A rack that a pinion moves: in the contact nothing slips, and no line has to be drawn for that.
#[test]
fn the_image_of_a_contact_falls_on_that_of_the_other_body() {
    for name in ["pairs/rack", "pairs/rack-on-moving-guide"] {
        let lines = told(&drawn(&common::example(name), &[]));
        let from = lines.iter().position(|line| line.contains("pole o;")).unwrap();
        let to = lines.iter().position(|line| line.contains("pole o′;")).unwrap();
        let all = lines[from..to].join("\n");
        assert!(all.contains("In the contact nothing slips"), "{all}");
        assert!(!all.contains("The lines meet"), "{all}");
    }
}

/// The lines of Zhukovsky's lever: each product closes, and the effort has its sense.
#[test]
fn lines_of_the_lever_close_and_end_with_a_sense() {
    let mut products = 0;
    for angle in [35, 55, 140, 230, 310] {
        let scene = common::read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O", "A"], "length": 45 }}, "3": {{ "joins": ["A", "B"], "length": 160 }} }},
            "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O", "angle": 90 }} }} ],
            "near": {{ "B": [0, 190] }}, "input": {{ "link": 2, "angle": {angle}, "omega": "3000 rpm cw" }}, "gravity": {{}},
            "masses": {{ "3": {{ "mass": 0.9, "inertia": 0.0031, "at": [50, 0] }}, "4": {{ "mass": 0.7 }} }},
            "loads": [ {{ "name": "P", "on": 4, "direction": -90, "pressure": "1.9 MPa", "bore": 80 }} ],
            "find": ["T(2)", {{ "name": "T(2)", "method": "lever" }}] }}"#
        ));
        let lines = told(&drawn(&scene, &[]));
        for line in lines.iter().filter(|line| line.contains("· y_") && line.contains(" W ")) {
            let mut parts = line.split(" = ").skip(1);
            let (factors, result) = (parts.next().unwrap(), parts.next().unwrap());
            let result: String = result.split(" W").next().unwrap().replace(' ', "");
            let (shown, ..) = number(&result).unwrap();
            // To the last figure that stands there.
            let place = result.split_once('.').map_or(1.0, |(_, after)| libm::exp10(-(after.len() as f64)));
            let off = (reckoned(factors).unwrap() - shown).abs();
            assert!(off <= 0.5 * place * (1.0 + 1e-6) || off <= 0.5e-4 * shown, "{line}: {off}");
            products += 1;
        }
        let effort = lines.iter().find(|line| line.contains("The effort balances it")).unwrap();
        assert!(effort.ends_with("cw.") || effort.ends_with("cw"), "{effort}");
    }
    assert!(products >= 10, "{products}");
}

/// One inertia force: its arm is one of the arms, with their names.
#[test]
fn an_arm_of_a_balance_has_a_number_where_the_shaking_force_has_the_same() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [200, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 70 }, "3": { "joins": ["A", "B"], "length": 190 },
                   "4": { "joins": ["O4", "B"], "length": 130 } },
        "near": { "B": [190, 130] }, "input": { "link": 2, "angle": 75, "omega": 9 }, "gravity": { "acts": false },
        "masses": { "4": { "mass": 7, "at": [60, 25] } }, "find": ["T(2)", "F(1,4)"] }"#,
    );
    let lines = told(&drawn(&scene, &[]));
    let measured: Vec<&String> = lines.iter().filter(|line| line.starts_with("Measured:")).collect();
    assert!(measured.iter().any(|line| line.contains("x_1")), "{measured:?}");
    assert!(measured.iter().all(|line| !line.contains(": e =") && !line.contains(", e =")), "{measured:?}");
}

/// Beside a crank θ₂ is its angle; the second crossing of the mean has another name.
#[test]
fn a_crossing_has_not_the_name_of_a_crank_s_angle() {
    let engine = KINDS.iter().find(|kind| kind.name == "engine").unwrap();
    let mut scene: serde_json::Value = serde_json::from_str(engine.scene).unwrap();
    let link = scene["input"]["link"].clone();
    scene["cycle"] = serde_json::json!({ "torque": { "of": link }, "fluctuation": 0.02 });
    scene["find"] = serde_json::json!(["T(2)", "crossing(1)", "crossing(2)", "Ef"]);
    let figure = drawn(&common::read(&scene.to_string()), &[]);
    let mut names = Vec::new();
    for table in within(&figure.root).into_iter().filter(|group| has(group, "results")) {
        for row in rows_of(table) {
            names.push(characters(row[0]).replace('_', ""));
        }
    }
    assert!(names.iter().all(|name| name != "θ2") && names.iter().any(|name| name == "θm2"), "{names:?}");
}

/// In a dead position of a governor several divisors vanish at once: it is one, and told once.
#[test]
fn a_dead_position_is_told_once() {
    let scene = common::read(
        r#"{ "units": { "length": "cm" }, "fixed": { "O": [3, 0] }, "placed": { "B": [16, -16] },
        "where": { "S": [ { "from": "B", "distance": 22 }, { "on": { "through": [3, 0], "angle": 90 } } ] },
        "links": { "2": { "joins": ["O", "B"] }, "3": { "joins": ["B", "S"] } },
        "slides": [ { "pin": "S", "block": 4, "on": { "link": 1, "through": "O", "angle": 90 }, "drag": 30 } ],
        "near": { "S": [3, -33] }, "input": { "link": 2 }, "gravity": {},
        "masses": { "2": { "mass": 4, "at": "B" }, "4": { "mass": 25 } },
        "spin": { "axis": { "through": [0, 0], "angle": 90 }, "omega": "?", "balls": 2, "sleeve": 4 },
        "find": ["spin(rising)", "spin(falling)"] }"#,
    );
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let dead: Vec<f64> = sweep
        .events
        .iter()
        .filter(|event| matches!(event.kind, EventKind::DeadPosition))
        .map(|event| event.at)
        .collect();
    assert!(dead.len() >= 3, "{dead:?}");
    for pair in dead.windows(2) {
        assert!(pair[1] - pair[0] > 1e-6, "{dead:?}");
    }
}

/// The angle of the greatest acceleration is told so that the torques there follow from it.
#[test]
fn torques_follow_from_the_angle_that_is_printed() {
    let scene = common::read(
        r#"{ "links": {}, "input": { "omega": "150 rpm" },
        "cycle": { "torque": { "harmonics": { "constant": 5000, "sin": [[2, 1500]], "cos": [[1, -600]] } },
                   "load": { "harmonics": { "constant": 5000, "sin": [[1, 700]] } },
                   "rotating": [ { "mass": 500, "gyration": "0.6 m" } ] },
        "find": ["Tmean", "alpha(max)", "angle(alpha_max)"] }"#,
    );
    let lines = told(&drawn(&scene, &[]));
    let angle = lines
        .iter()
        .filter(|line| line.contains("α_max"))
        .find_map(|line| line.rsplit_once("= 0: ")?.1.rsplit_once("= ").map(|(_, a)| a.to_owned()));
    let angle = number(&angle.unwrap()).unwrap().0.to_radians();
    let torque = 5000.0 + 1500.0 * libm::sin(2.0 * angle) - 600.0 * libm::cos(angle);
    let line = lines.iter().find(|line| line.contains("/ I = (")).unwrap();
    let shown = number(line.split("/ I = (").nth(1).unwrap()).unwrap().0;
    assert!((torque - shown).abs() < 1.0, "{torque}: {line}");
}

/// Coriolis of a wheel on a turning plane is laid off along no line that has a name: its direction stands in the table by its
/// angle, as in the line that lays it off. By the pole: the plane has no lines but those of its link.
#[test]
fn what_is_laid_off_by_its_angle_has_it_in_the_table() {
    let figure = drawn(&common::example("pairs/wheel-on-moving-plane"), &[]);
    let laid_off = told(&figure).into_iter().find(|line| line.starts_with("Lay off A^c_C3C2")).unwrap();
    let angle = laid_off.split("∠ ").nth(1).unwrap().trim_end_matches('.').to_owned();
    let tables = within(&figure.root).into_iter().filter(|group| has(group, "terms"));
    let cells: Vec<String> = tables
        .flat_map(|table| &table.children)
        .filter_map(|node| match node {
            Node::Text(text) => Some(characters(text).replace('\u{a0}', " ")),
            _ => None,
        })
        .collect();
    assert!(cells.iter().any(|cell| *cell == format!("∠ {angle}")), "{angle}: {cells:?}");
}

/// At the tip of an arrow to a centre off the sheet stands how far on that lies, and that it is that.
#[test]
fn a_centre_off_the_sheet_is_so_far_from_the_tip() {
    // Crank and rocker are nearly parallel: their lines meet some metres off.
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 98 },
                   "4": { "joins": ["O4", "B"], "length": 60 } },
        "near": { "B": [110, 58] }, "input": { "link": 2, "angle": 82, "omega": 5 },
        "find": ["I(1,3)", "I(2,4)"] }"#,
    );
    let (a, pivot) = (times(unit(82_f64.to_radians()), 60.0), [100.0, 0.0]);
    let base = minus(pivot, a);
    let along = (98.0 * 98.0 - 60.0 * 60.0 + dot(base, base)) / (2.0 * long(base));
    let d = times(base, 1.0 / long(base));
    let off = libm::sqrt(98.0 * 98.0 - along * along);
    let b = plus(a, plus(times(d, along), [-off * d[1], off * d[0]]));
    assert!(long(minus(b, [110.0, 58.0])) < 10.0, "{b:?}");
    // Where two lines meet, each through a point and along a direction.
    let meet = |p: Xy, u: Xy, q: Xy, v: Xy| plus(p, times(u, cross(minus(q, p), v) / cross(u, v)));
    let centres = [
        ("(13)", meet([0.0; 2], a, pivot, minus(b, pivot))),
        ("(24)", meet([0.0; 2], pivot, a, minus(b, a))),
    ];
    let figure = drawn(&scene, &["centres"]);
    let joint = |name: &str| {
        let within = within(&figure.root);
        let joint = within.iter().find(|group| has(group, "joint") && data(group, "point") == Some(name));
        let centre = marks(joint.unwrap()).find_map(|mark| match mark.shape {
            Shape::Circle { centre, .. } => Some(centre),
            _ => None,
        });
        centre.unwrap()
    };
    let (origin, scale) = (joint("O2"), joint("O2").distance(joint("O4")) / 100.0);
    let on_page = |[x, y]: Xy| Point::new(origin.x + scale * x, origin.y - scale * y);
    let ends: Vec<Point> =
        within(&figure.root).into_iter().flat_map(lines).flat_map(|(from, to)| [from, to]).collect();
    let mut seen = 0;
    for group in within(&figure.root) {
        for node in &group.children {
            let Node::Text(text) = node else { continue };
            let words = characters(text).replace('\u{a0}', " ");
            if text.class == "label centre-name" && (words.contains(" mm") || words.contains(" m")) {
                seen += 1;
                let (distance, half, rest) = number(&words).unwrap();
                let of = rest.split_once(" mm to ").unwrap_or_else(|| panic!("{words}")).1;
                let centre = centres.iter().find(|(name, _)| *name == of).unwrap().1;
                let from = |tip: &&Point| {
                    (tip.distance(on_page(centre)) / scale - distance).abs() <= half * (1.0 + 1e-6)
                };
                assert!(ends.iter().any(|tip| from(&tip)), "{words}: {centre:?}");
            }
        }
    }
    assert!(seen > 0);
}
