//! What an examiner of sixty sheets would not sign: a table that says other than its line, data told in axes that nobody names, a
//! proportion that does not come out, a circle that lies off its paper, a vector that is named and not drawn, one letter for two
//! quantities.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use serde_json::json;

use linkgram::drawing::{self, Wish};
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::figure::{Figure, Group, Node, Shape};
use linkgram::sheet::{self, Language};

use crate::common;
use crate::common::plane::{long, minus, plus, times, unit};
use crate::legibility::{characters, has, number, sentences, within};
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
fn four_bars(count: usize) -> Vec<serde_json::Value> {
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
    // The figure stands at 1 : 2.
    let length = long(relative) / (omega * omega) / 2.0;
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
