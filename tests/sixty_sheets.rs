//! What an examiner of sixty sheets would not sign: a table that says other than its line, data told in axes that nobody names, a
//! proportion that does not come out, a circle that lies off its paper, a vector that is named and not drawn, one letter for two
//! quantities.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use serde_json::json;

use kurbo::Point;
use linkgram::drawing::{self, Wish};
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::figure::{Figure, Group, Mark, Node, Shape};
use linkgram::sheet::{self, Language};

use crate::common;
use crate::common::plane::{long, minus, plus, times, unit};
use crate::legibility::{characters, data, has, marks, number, rows_of, sentences, within};
use crate::third_examiner::{left, resolve};

fn plain(text: &str) -> String {
    text.replace(['\u{a0}', '\u{2009}'], " ")
}

fn solution(scene: &Scene) -> Figure {
    let solved = linkgram::solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    sheet::solution(scene, &solved.solution.construction, Language::English)
}

fn texts(group: &Group) -> Vec<String> {
    let texts = group.children.iter().filter_map(|node| match node {
        Node::Text(text) => Some(plain(&characters(text))),
        _ => None,
    });
    texts.collect()
}

fn told(figure: &Figure) -> Vec<String> {
    sentences(figure).iter().map(|line| plain(line)).collect()
}

/// Crank-rockers and double rockers, by a generator of remainders.
pub fn four_bars(count: usize) -> Vec<serde_json::Value> {
    let mut state = 20_261_128_u64;
    let mut between = |low: f64, high: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64).round()
    };
    let mut all = Vec::new();
    while all.len() < count {
        let [crank, rod, rocker] = [between(30.0, 60.0), between(90.0, 140.0), between(70.0, 100.0)];
        let (pivot, angle, omega) =
            ([between(60.0, 110.0), between(-15.0, 15.0)], between(0.0, 359.0), between(3.0, 30.0));
        let pin = [crank * angle.to_radians().cos(), crank * angle.to_radians().sin()];
        let far = [pivot[0] - pin[0], pivot[1] - pin[1]];
        let apart = far[0].hypot(far[1]);
        let along = (rod * rod - rocker * rocker + apart * apart) / (2.0 * apart);
        let half = rod * rod - along * along;
        if half < 400.0 {
            continue;
        }
        let unit = [far[0] / apart, far[1] / apart];
        let end = [
            pin[0] + along * unit[0] - half.sqrt() * unit[1],
            pin[1] + along * unit[1] + half.sqrt() * unit[0],
        ];
        all.push(json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": pivot },
            "links": { "2": { "joins": ["O2", "A"], "length": crank }, "3": { "joins": ["A", "B"], "length": rod },
                       "4": { "joins": ["O4", "B"], "length": rocker } },
            "near": { "B": end }, "input": { "link": 2, "angle": angle, "omega": format!("{omega} rad/s ccw") }
        }));
    }
    all
}

/// What is found by centres stands in the table as the lines have come to it: where a measured length carries no more figures,
/// the table does not know better than they do.
#[test]
fn a_table_says_what_the_lines_of_the_same_method_say() {
    let (mut compared, mut wrong) = (0, Vec::new());
    for mut scene in four_bars(60) {
        let by = |name: &str| json!({ "name": name, "method": "centres" });
        scene["find"] = json!([by("v(B)"), by("omega(4)"), by("omega(3)")]);
        let figure = solution(&common::read(&scene.to_string()));
        let lines = told(&figure);
        for table in within(&figure.root).into_iter().filter(|group| has(group, "results")) {
            for cells in texts(table).windows(2) {
                let Some(symbol) = cells[0].strip_suffix(", instant centres") else { continue };
                let Some((value, half, _)) = number(&cells[1]) else { continue };
                let begins = [format!("{symbol} = "), format!(": {symbol} = ")];
                let line =
                    lines.iter().rev().find(|line| line.starts_with(&begins[0]) || line.contains(&begins[1]));
                let Some(line) = line else { continue };
                let end = line.rsplit(" = ").next().unwrap();
                let Some((own, ..)) = number(end) else { continue };
                compared += 1;
                if (own - value).abs() > half * (1.0 + 1e-6) {
                    wrong.push(format!("{} but {line}", cells.join(" ")));
                }
            }
        }
    }
    assert!(compared > 120, "{compared}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Own coordinates of a moving link say whose axes they are, of an arc as of a line.
#[test]
fn the_centre_of_an_arc_says_in_whose_axes_it_lies() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, -110] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "4": { "joins": ["O4", "B"], "length": 180 } },
        "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "centre": [90, 120], "radius": 120 } }],
        "near": { "A": [0, 40], "B": [60, 60] }, "input": { "link": 2, "angle": 100, "omega": "10 rad/s ccw" },
        "find": ["omega(4)"] }"#,
    );
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let question = sheet::question(&scene, &solved.solution.construction, Language::English);
    let mut all = String::new();
    question.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all += &plain(&characters(text).replace('_', ""));
            all.push(' ');
        }
    });
    assert!(all.contains("arc about (90; 120) mm from O4, x along O4B, radius 120 mm"), "{all}");
}

/// A number with its sense: clockwise is negative.
fn signed(text: &str) -> Option<(f64, f64)> {
    let (value, half, rest) = number(text)?;
    let is_cw = rest.split_whitespace().any(|word| word.trim_end_matches(['.', ',', ';', ':']) == "cw");
    Some((if is_cw { -value } else { value }, half))
}

/// First trial, second trial and what is read of both give the rate that is printed.
#[test]
fn a_proportion_comes_out_as_it_is_printed() {
    let mut compared = 0;
    for (name, scene) in common::scenes() {
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene);
        let Ok(solved) = solved else { continue };
        let lines = told(&sheet::solution(&scene, &solved.solution.construction, Language::English));
        let mut tried: Option<[f64; 2]> = None;
        for line in &lines {
            // Draw two trial polygons: with ω = 0.7 … and with ω = 1.5 …. The sought image lies …
            if let Some((first, second)) = line.split_once(" and with ") {
                let second = second.split(". ").next().unwrap();
                let value = |text: &str| Some(signed(text.rsplit_once(" = ")?.1)?.0);
                if let (Some(a), Some(b)) = (value(first), value(second)) {
                    tried = Some([a, b]);
                }
            }
            let (Some([a, b]), Some((read, rate))) = (tried, line.split_once("By proportion")) else {
                continue;
            };
            let lengths: Vec<f64> =
                read.split(" = ").skip(1).filter_map(|part| number(part).map(|(mm, ..)| mm)).collect();
            let rate = rate.split_once(" = ").unwrap().1.split(';').next().unwrap();
            let (&[part, whole], Some((value, half))) = (&lengths[..], signed(rate)) else { continue };
            // The image may lie on either side of the first trial's.
            let either = [1.0, -1.0].map(|ahead| a + (b - a) * ahead * part / whole);
            compared += 1;
            assert!(
                either.iter().any(|own| (own - value).abs() <= half * (1.0 + 1e-6)),
                "{name}: {a} and {b}: {line} gives {either:?}"
            );
        }
    }
    assert!(compared > 2, "{compared}");
}

/// An inflection circle that no paper holds is shown as far as one does, and what lies beyond is named where its lines end, with
/// its distance: of W from the pole a_P/ω², a_P being the acceleration of the coupler's point at the pole.
#[test]
fn what_lies_beyond_a_construction_is_named() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [75, 2] },
        "links": { "2": { "joins": ["O2", "A"], "length": 35 }, "3": { "joins": ["A", "B"], "length": 119 },
                   "4": { "joins": ["O4", "B"], "length": 84 } },
        "near": { "B": [114.22, -72.28] }, "input": { "link": 2, "angle": 272, "omega": "26 rad/s ccw" },
        "find": ["omega(3)", "alpha(3)"], "sheet": { "figures": ["inflection(3)"] } }"#;
    let (pivot, omega) = ([75.0, 2.0], 26.0);
    let a = times(unit(272_f64.to_radians()), 35.0);
    let base = minus(pivot, a);
    let (far, d) = (long(base), times(base, 1.0 / long(base)));
    let along = (119.0_f64.powi(2) - 84.0_f64.powi(2) + far * far) / (2.0 * far);
    let b = plus(a, plus(times(d, along), times(left(d), -(119.0_f64.powi(2) - along * along).sqrt())));
    assert!(long(minus(b, [114.22, -72.28])) < 0.1, "{b:?}");
    let (ab, ob) = (minus(b, a), minus(b, pivot));
    let across = [left(ab), times(left(ob), -1.0)];
    let [rod, rocker] = resolve(times(left(a), -omega), across);
    let normals = plus(times(a, omega * omega), plus(times(ab, rod * rod), times(ob, -rocker * rocker)));
    let [alpha, _] = resolve(normals, across);
    let [on_crank, _] = resolve(pivot, [a, times(ob, -1.0)]);
    let arm = minus(times(a, on_crank), a);
    let of_pole = plus(times(a, -omega * omega), plus(times(left(arm), alpha), times(arm, -rod * rod)));
    let diameter = long(of_pole) / (rod * rod);

    let scene = common::read(text);
    let wish = Wish { figures: vec!["inflection(3)".to_owned()], ..Wish::default() };
    let figure = drawing::figure(&scene, &wish).unwrap_or_else(|why| panic!("{}", why.told(&scene)));
    let mut all: Vec<String> = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.push(plain(&characters(text)));
        }
    });
    assert!(all.iter().any(|name| name == "(13)"), "{all:?}");
    let told = |name: &String| {
        let (value, half, _) = number(name.strip_prefix("W ")?)?;
        Some((value - diameter).abs() <= half * (1.0 + 1e-6))
    };
    assert!(all.iter().filter_map(told).any(|is_it| is_it), "{diameter}: {all:?}");
}

/// In Klein's construction the acceleration of the slider's pin against the crank's is drawn from end to end: |a_BA|/ω² of the
/// crank, by the scale of the skeleton.
#[test]
fn what_is_read_in_kleins_construction_is_drawn() {
    let (crank, rod, low) = (50.0, 130.0, -15.0);
    let (omega, alpha) = (10.0 * std::f64::consts::PI, 500.0);
    let a = times(unit(55_f64.to_radians()), crank);
    let ab = [(rod * rod - (low - a[1]).powi(2)).sqrt(), low - a[1]];
    let va = times(left(a), omega);
    let aa = plus(times(left(a), alpha), times(a, -omega * omega));
    // Nothing of B moves upward.
    let turning = -va[1] / left(ab)[1];
    let gathering = -(aa[1] - turning * turning * ab[1]) / left(ab)[1];
    let relative = plus(times(left(ab), gathering), times(ab, -turning * turning));

    let scene = common::example("constructions/klein");
    let wish = Wish { figures: vec!["klein".to_owned()], ..Wish::default() };
    let figure = drawing::figure(&scene, &wish).unwrap_or_else(|why| panic!("{}", why.told(&scene)));
    let mut drawn = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Mark(mark) = node
            && let Shape::Line(from, to) = mark.shape
        {
            drawn.push(from.distance(to));
        }
    });
    // The figure stands at 1 : 1.
    let length = long(relative) / (omega * omega);
    assert!(drawn.iter().any(|mm| (mm - length).abs() < 1e-6), "{length}: {drawn:?}");
}

/// A load P and the mean power have two letters.
#[test]
fn power_is_no_second_load() {
    let figure = solution(&common::example("forces/gas-engine"));
    let tables: Vec<&Group> =
        within(&figure.root).into_iter().filter(|group| has(group, "results")).collect();
    let symbols: Vec<String> =
        tables.into_iter().flat_map(texts).filter(|text| text.starts_with('P')).collect();
    let plain = symbols.iter().filter(|symbol| *symbol == "P").count();
    assert!(plain <= 1 && symbols.iter().any(|symbol| symbol == "P_m"), "{symbols:?}");
}

/// The panels of a sheet whose drawing is of this class.
pub fn panels<'a>(figure: &'a Figure, class: &str) -> Vec<&'a Group> {
    within(&figure.root).into_iter().filter(|group| has(group, class)).collect()
}

/// Where a joint stands in a panel.
pub fn joint(panel: &Group, name: &str) -> Point {
    let all = within(panel);
    let own = all.iter().find(|group| has(group, "joint") && data(group, "point") == Some(name));
    let circle = own.into_iter().flat_map(|own| marks(own)).find_map(|mark| match mark.shape {
        Shape::Circle { centre, .. } => Some(centre),
        _ => None,
    });
    circle.unwrap_or_else(|| panic!("{name} is drawn"))
}

/// Where circles about two points meet, to the left of the way from the first to the second.
fn third(a: [f64; 2], b: [f64; 2], from_a: f64, from_b: f64) -> [f64; 2] {
    let base = minus(b, a);
    let (far, d) = (long(base), times(base, 1.0 / long(base)));
    let along = (from_a.powi(2) - from_b.powi(2) + far * far) / (2.0 * far);
    plus(a, plus(times(d, along), times(left(d), (from_a.powi(2) - along * along).sqrt())))
}

/// Where two lines meet, each through a point and along a direction.
fn meet(p: [f64; 2], u: [f64; 2], q: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    plus(p, times(u, cross(minus(q, p), v) / cross(u, v)))
}

/// The arms of this six-link meet far below it: the figure of centres is smaller for it, so that (13) is on its paper, in its
/// place; the skeleton is not, nor the figures in which velocities are carried over.
#[test]
fn a_far_centre_makes_its_own_figure_smaller() {
    let scene = common::read(
        r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [30, -5] },
        "links": { "2": { "joins": ["O2", "A"], "length": 12 }, "3": { "joins": ["A", "B"], "length": 28 },
                   "4": { "joins": ["O4", "B", "C"], "arms": [20, 16, -40] }, "5": { "joins": ["C", "D"], "length": 34 } },
        "slides": [{ "pin": "D", "block": 6, "on": { "link": 1, "through": [0, -5], "angle": 0 } }],
        "near": { "B": [28, 15], "D": [70, -5] }, "input": { "link": 2, "angle": 130, "omega": "15 rad/s ccw" },
        "find": [{ "name": "v(D)", "method": "gauge-line" }, { "name": "omega(5)", "method": "line-of-centres" },
                 { "name": "v(C)", "method": "link-to-link" }] }"#,
    );
    let (a, pivot) = (times(unit(130_f64.to_radians()), 12.0), [30.0, -5.0]);
    let b = third(a, pivot, 28.0, 20.0);
    assert!(long(minus(b, [28.0, 15.0])) < 12.0, "{b:?}");
    let pole = meet([0.0; 2], a, pivot, minus(b, pivot));

    let figure = solution(&scene);
    let frame = |panel: &Group| joint(panel, "O2").distance(joint(panel, "O4"));
    let skeleton = frame(panels(&figure, "skeleton")[0]);
    let far = panels(&figure, "instant-centres");
    assert_eq!(far.len(), 1);
    assert!(panels(&figure, "transfer").into_iter().all(|panel| (frame(panel) - skeleton).abs() < 1e-6));
    for panel in far {
        let own = frame(panel);
        assert!(skeleton > 1.5 * own, "{skeleton} {own}");
        let (origin, scale) = (joint(panel, "O2"), own / long(pivot));
        let at = Point::new(origin.x + scale * pole[0], origin.y - scale * pole[1]);
        let all = within(panel);
        let centre = all.iter().find(|group| data(group, "centre") == Some("(13)"));
        let centre = centre.unwrap_or_else(|| panic!("(13) is on the paper"));
        let stands =
            |mark: &Mark| matches!(mark.shape, Shape::Circle { centre, .. } if centre.distance(at) < 0.02);
        assert!(marks(centre).any(stands), "{at:?}");
        assert!(at.y > 0.0 && at.x > 0.0 && at.x < figure.width && at.y < figure.height, "{at:?}");
    }
}

/// Nobody measures what is not on his paper: on A4 no two points are further from each other than its diagonal. What lies
/// beyond is calculated, and right.
#[test]
fn what_is_measured_is_on_the_paper() {
    let diagonal = 176_f64.hypot(263.0);
    let mut beyond = 0;
    for mut sheet in four_bars(12) {
        sheet["find"] = json!(["I(1,3)", { "name": "omega(4)", "method": "centres" },
            { "name": "omega(3)", "method": "gauge-line" }]);
        let scene = common::read(&sheet.to_string());
        for line in told(&solution(&scene)) {
            if let Some(rest) = line.strip_prefix("Measured: (") {
                let (mm, ..) = rest.split_once(" = ").and_then(|(_, value)| number(value)).unwrap();
                assert!(mm <= diagonal, "{line}");
            }
            beyond += usize::from(line.contains("is not on the paper"));
        }
    }
    assert!(beyond > 0, "no centre lies beyond the paper");

    // Cranks that are parallel within two degrees.
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [130, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 120 },
                   "4": { "joins": ["O4", "B"], "length": 90 } },
        "near": { "B": [105, 85] }, "input": { "link": 2, "angle": 110, "omega": "10 rad/s ccw" },
        "find": ["I(1,3)", { "name": "omega(3)", "method": "gauge-line" }] }"#,
    );
    let (a, pivot) = (times(unit(110_f64.to_radians()), 50.0), [130.0, 0.0]);
    let b = third(a, pivot, 120.0, 90.0);
    let pole = meet([0.0; 2], a, pivot, minus(b, pivot));
    let radius = long(minus(pole, a));
    assert!(radius > 2000.0, "{radius}");
    let all = told(&solution(&scene));
    let own = |line: &&String| line.contains("not on the paper") && line.contains("(13–A) = ");
    let line = all.iter().find(own).unwrap_or_else(|| panic!("{all:?}"));
    let (value, half, _) = line.split_once("(13–A) = ").and_then(|(_, value)| number(value)).unwrap();
    assert!((value - radius).abs() <= half.max(1e-3 * radius), "{line}: {radius}");
    assert!(all.iter().any(|line| line.starts_with("Not on the paper") && line.contains("I_13")), "{all:?}");
}

/// Where ω is asked by a gauge line, that line is drawn, from the pole through the tip of the known velocity: its slope against
/// the radius is ω, by the scales.
#[test]
fn a_rate_by_a_gauge_line_has_its_line() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [130, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 120 },
                   "4": { "joins": ["O4", "B"], "length": 90 } },
        "near": { "B": [145, 88] }, "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
        "find": [{ "name": "omega(3)", "method": "gauge-line" }],
        "sheet": { "length": "1:2", "velocity": "20 mm/s per mm" } }"#,
    );
    let (a, pivot) = (times(unit(60_f64.to_radians()), 50.0), [130.0, 0.0]);
    let b = third(a, pivot, 120.0, 90.0);
    let pole = meet([0.0; 2], a, pivot, minus(b, pivot));
    let slope = 10.0 * 50.0 / 20.0 / (long(minus(pole, a)) / 2.0);
    let figure = solution(&scene);
    let transfer = panels(&figure, "transfer")[0];
    let gauge = within(transfer).into_iter().find(|group| has(group, "gauge-line")).unwrap();
    let ways: Vec<_> = marks(gauge)
        .filter_map(|mark| match mark.shape {
            Shape::Line(from, to) => Some((to - from).normalize()),
            _ => None,
        })
        .collect();
    assert_eq!(ways.len(), 2, "the line and the radius");
    let found = (ways[0].cross(ways[1]) / ways[0].dot(ways[1])).abs();
    assert!((found / slope - 1.0).abs() < 1e-6, "{found} {slope}");
    assert!(told(&figure).iter().any(|line| line.starts_with("Draw the gauge line from (13)")));
}

/// A rack on a pin touches a wheel: before a point is marked on it, a step says how its line is found. The point of contact is
/// where Thales' circle says.
#[test]
fn a_rack_on_a_pin_is_laid_on_by_its_tangent() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, 80] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 150 },
                   "4": { "joins": ["O4"] } },
        "rolls": [{ "links": [3, 4], "line": { "link": 3, "through": "A", "toward": "B" }, "centre": "O4",
                    "radius": 25 }],
        "near": { "B": [-60, 150] }, "input": { "link": 2, "angle": 20, "omega": "5 rad/s ccw" },
        "find": ["omega(3)"] }"#,
    );
    let all = told(&solution(&scene));
    let tangent = all.iter().position(|line| line.contains("Thales")).unwrap_or_else(|| panic!("{all:?}"));
    assert!(
        all[tangent].contains("25 mm about O_4") && all[tangent].contains("over AO_4"),
        "{}",
        all[tangent]
    );
    let marked = all.iter().position(|line| line.starts_with("Mark B")).unwrap();
    assert!(tangent < marked, "{all:?}");
    // Arabic and Persian have it as well.
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    for (language, word) in [(Language::Arabic, "طاليس"), (Language::Persian, "تالس")] {
        let figure = sheet::solution(&scene, &solved.solution.construction, language);
        let mut there = false;
        figure.root.walk(&mut |node| {
            if let Node::Text(text) = node {
                there |= characters(text).contains(word);
            }
        });
        assert!(there, "{word}");
    }
}

/// What the lever comes to in its line stands in the table.
#[test]
fn the_table_says_of_the_lever_what_its_line_says() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 210 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }], "near": { "B": [240, 0] },
        "input": { "link": 2, "angle": 65, "omega": "90 rad/s ccw" },
        "masses": { "3": { "mass": 1.6, "at": [75, 0], "inertia": 0.01 }, "4": { "mass": 1.1 } },
        "loads": [{ "name": "P", "on": 4, "force": "1500 N", "direction": 180 }],
        "find": [{ "name": "Fin(3)", "method": "two-masses", "first": "B" }, { "name": "T(2)", "method": "lever" }] }"#,
    );
    let figure = solution(&scene);
    let all = told(&figure);
    let line = all.iter().find(|line| line.contains("|ΣM| / |ω_2|")).unwrap_or_else(|| panic!("{all:?}"));
    let (value, ..) = line.rsplit_once("= ").and_then(|(_, value)| number(value)).unwrap();
    let rows = panels(&figure, "results").into_iter().flat_map(rows_of);
    let rows: Vec<Vec<String>> =
        rows.map(|row| row.into_iter().map(|text| plain(&characters(text))).collect()).collect();
    let row = rows.iter().find(|row| row[0].contains("lever")).unwrap_or_else(|| panic!("{rows:?}"));
    assert_eq!(number(&row[1]).unwrap().0, value, "{row:?}: {line}");
}

/// A single body has one force polygon, which is that of all outer forces.
#[test]
fn a_polygon_is_not_drawn_twice() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "S": [140, 90] },
        "links": { "2": { "joins": ["O2", "A", "B"], "arms": [120, 90, 70] } },
        "input": { "link": 2, "angle": 15 }, "gravity": {}, "masses": { "2": { "mass": 6, "at": "A" } },
        "springs": [{ "name": "S", "between": [{ "link": 2, "at": "B" }, { "link": 1, "at": "S" }], "force": "?" }],
        "find": ["spring(S)", "F(1,2)"] }"#,
    );
    let figure = solution(&scene);
    assert_eq!(panels(&figure, "polygon").len(), 1);
    assert!(!told(&figure).iter().any(|line| line.contains("closes with a gap")));
}

/// Forces that run back over each other in one line lie beside each other: no two arrows share a stroke.
#[test]
fn forces_of_one_line_lie_beside_each_other() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "4": { "joins": ["C"] } },
        "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": "C", "angle": 90 } },
                   { "link": 4, "on": { "link": 1, "through": "O2" } }],
        "near": { "C": [40, 0] }, "masses": { "4": { "mass": 3 } },
        "loads": [{ "name": "P", "on": 4, "at": "C", "force": 200, "direction": 180 }],
        "input": { "link": 2, "angle": 40, "omega": "20 rad/s ccw" }, "find": ["T(2)", "F(3,4)"] }"#,
    );
    let figure = solution(&scene);
    let polygons: Vec<&Group> =
        panels(&figure, "polygon").into_iter().filter(|group| has(group, "force")).collect();
    assert!(!polygons.is_empty());
    for polygon in polygons {
        let arrows: Vec<(Point, Point)> = within(polygon)
            .into_iter()
            .filter(|group| has(group, "vector"))
            .filter_map(|group| {
                marks(group).find_map(|mark| match mark.shape {
                    Shape::Line(from, to) => Some((from, to)),
                    _ => None,
                })
            })
            .collect();
        assert!(arrows.len() >= 3, "{arrows:?}");
        for (i, a) in arrows.iter().enumerate() {
            for b in &arrows[i + 1..] {
                let along = (a.1 - a.0).normalize();
                let off = |p: Point| (p - a.0).cross(along).abs();
                let on = off(b.0) < 1.0 && off(b.1) < 1.0;
                let reach = |p: Point| (p - a.0).dot(along);
                let (low, high) = (reach(b.0).min(reach(b.1)), reach(b.0).max(reach(b.1)));
                let shared = high.min(a.0.distance(a.1)) - low.max(0.0);
                assert!(!on || shared < 0.5, "{a:?} {b:?}");
            }
        }
    }
}

/// An arm leads to the line of its force, and the force stands on that line, the shaking force as well.
#[test]
fn the_force_of_an_asked_arm_is_drawn() {
    let figure = drawn_figure(&common::example("forces/s000-ch5-20"), "forces");
    let arms = within(&figure.root)
        .into_iter()
        .filter(|group| has(group, "panel"))
        .find(|panel| texts(panel).iter().any(|text| text.contains("Arms of forces")));
    let arms = arms.unwrap_or_else(|| panic!("a panel of arms"));
    let names: Vec<String> = within(arms)
        .into_iter()
        .filter(|group| has(group, "force"))
        .filter_map(|group| data(group, "quantity").map(str::to_owned))
        .collect();
    assert!(names.iter().any(|name| name.starts_with("FS") || name.contains("shaking")), "{names:?}");
}

fn drawn_figure(scene: &Scene, name: &str) -> Figure {
    let wish = Wish { figures: vec![name.to_owned()], ..Wish::default() };
    drawing::figure(scene, &wish).unwrap_or_else(|why| panic!("{}", why.told(scene)))
}

/// A wheel between two others has one radius.
#[test]
fn the_radius_of_a_wheel_is_dimensioned_once() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O"] }, "3": { "joins": ["A", "P"] }, "4": { "joins": ["O", "A"] },
                   "5": { "joins": ["O"] } },
        "placed": { "A": [51.96152423, 30], "P": [60, 38] },
        "rolls": [{ "links": [2, 3], "centres": ["O", "A"], "radii": [40, 20] },
                  { "links": [5, 3], "centres": ["O", "A"], "radii": [80, 20], "internal": true }],
        "inputs": [{ "link": 2, "angle": 0, "omega": "12 rad/s ccw" }, { "link": 5, "angle": 0, "omega": "3 rad/s cw" }],
        "find": ["omega(3)"] }"#,
    );
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_question).unwrap();
    let figure = sheet::question(&scene, &solved.solution.construction, Language::English);
    let mut radii = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            radii.push(plain(&characters(text)));
        }
    });
    let twenty = radii.iter().filter(|text| text.replace(' ', "") == "R20").count();
    assert_eq!(twenty, 1, "{radii:?}");
}

/// A link that its own pins nearly hide is drawn larger where the paper has the room: the arm of the hypocycloid drive.
#[test]
fn no_link_is_hidden_where_the_paper_has_room() {
    let kind = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == "hypocycloid").unwrap();
    let scene = common::read(kind.scene);
    let figure = solution(&scene);
    let skeleton = panels(&figure, "skeleton")[0];
    let arm = joint(skeleton, "A").distance(joint(skeleton, "B"));
    assert!(arm > 8.0, "{arm}");
}
