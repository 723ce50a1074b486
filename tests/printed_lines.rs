//! What an examiner marked on sheets: a line that uses other numbers than stand above it, a quantity that no line derives, a
//! construction without its reason, a symbol that nobody explains.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::collections::HashMap;

use crate::common;
use crate::legibility::{characters, has, number, reckoned, sentences, within};

use linkgram::mechanism::quantity::{Answer, DiagramKind, Quantity};
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::figure::Node;
use linkgram::sheet::{self, Figure, Language};
use linkgram::solve::Solved;

fn solved(scene: &Scene) -> Solved {
    linkgram::solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap()
}

fn solution(scene: &Scene) -> Figure {
    sheet::solution(scene, &solved(scene).solution.construction, Language::English)
}

/// The sentences with plain blanks.
fn told(figure: &Figure) -> Vec<String> {
    sentences(figure).into_iter().map(|line| line.replace(['\u{a0}', '\u{2009}'], " ")).collect()
}

/// The question sheet as one text with plain blanks.
fn question(scene: &Scene) -> String {
    let figure = sheet::question(scene, &solved(scene).solution.construction, Language::English);
    let mut all = String::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.push_str(&characters(text).replace(['\u{a0}', '\u{2009}'], " "));
            all.push(' ');
        }
    });
    all
}

/// The value at the end of a line, before its unit.
fn value_of(text: &str) -> f64 {
    number(text.trim()).unwrap_or_else(|| panic!("no number in {text}")).0
}

const PRESS: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 80}, "3": {"joins": ["A", "B"], "length": 320}},
    "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": "O2", "angle": -90}}], "near": {"B": [0, -300]},
    "input": {"link": 2, "angle": 10, "omega": "90 rpm ccw"}, "gravity": {},
    "masses": {"4": {"mass": 60}, "3": {"mass": 12, "at": [120, 0], "inertia": 0.1}},
    "loads": [{"name": "P", "on": 4, "direction": 90,
        "force": {"table": [[0, 0], [230, 0], [230, "20 kN"], [262, "8 kN"], [262, 0]]}}],
    "cycle": {"load": {"of": 2}, "fluctuation": 0.1, "rotating": [{"inertia": 1.5, "ratio": 4}]},
    "find": ["Tmean", "E", "Ef", "If", "I", "Ke", "level(1)", "level(2)", "power"]}"#;

const FOUR_COPIES: &str = r#"{"links": {}, "input": {"omega": "1500 rpm"}, "cycle": {
    "torque": {"table": [[0, 0], [30, 900], [90, 400], [180, 0], [360, 0], [450, -60], [540, 0], [630, -120]]},
    "period": 720, "copies": {"number": 4, "shift": 180}, "rotating": [{"inertia": 0.8}]},
    "find": ["Tmean", "E", "power", "Emax", "Emin", "Ef", "Ke", "Ks", "I"]}"#;

const WAVES: &str = r#"{"units": {"torque": "kN*m", "length": "mm"}, "links": {}, "input": {"omega": "25 rad/s"}, "cycle": {
    "torque": {"harmonics": {"constant": 5, "sin": [[2, 2.2], [3, 0.4]], "cos": [[1, -1]]}},
    "load": {"harmonics": {"constant": 5, "cos": [[1, 1.7]]}}, "fluctuation": 0.03,
    "rotating": [{"weight": "2 kN", "gyration": 400, "ratio": 2}]},
    "find": ["Tmean", "power", "Ef", "Emax", "Emin", "If", "I", "level(1)", "level(2)", "area(2)"]}"#;

/// What turns already is too light for the fluctuation that is wanted: a flywheel comes to it, and both count in K_s.
const WANTED: &str = r#"{"units": {"torque": "kN*m"}, "links": {}, "input": {"omega": "30 rpm"}, "cycle": {
    "load": {"table": [[0, 0.2], [120, 0.2], [120, 6], [150, 6], [150, 0.2], [360, 0.2]]},
    "rotating": [{"inertia": 900}], "fluctuation": 0.1}, "find": ["Tmean", "Ef", "Ks", "I"]}"#;

/// The parts of a sum of symbols or numbers: `E_1 + A_1`, `511.89 − (−4.21)`.
fn parts(text: &str) -> Vec<String> {
    let text =
        text.replace(" × ", "\u{1}").replace(" / ", "\u{1}").replace(" + ", "\u{1}").replace(" − ", "\u{1}");
    let bare = |part: &str| part.trim_matches([' ', '(', ')', '|']).trim_end_matches('²').replace("^2", "");
    text.split('\u{1}').map(bare).collect()
}

/// Every line of a turning-moment diagram comes out of its own printed numbers, and takes those that stand above it.
#[test]
fn lines_of_a_cycle_take_what_stands_above_them() {
    let (mut uses, mut lines, mut wrong) = (0, 0, Vec::new());
    let scenes = [("press", PRESS), ("four copies", FOUR_COPIES), ("waves", WAVES), ("wanted", WANTED)];
    let mut all: Vec<(String, Scene)> =
        scenes.into_iter().map(|(name, text)| (name.to_owned(), common::read(text))).collect();
    all.extend(common::scenes().into_iter().filter(|(_, scene)| scene.mechanism.forces.cycle.is_some()));
    for (name, scene) in &all {
        let mut printed: HashMap<String, f64> = HashMap::new();
        let sheet = told(&solution(scene));
        let begins = sheet.iter().position(|line| line.starts_with("E_") || line.starts_with("A_1"));
        for line in &sheet[begins.unwrap_or(0)..] {
            let equal: Vec<&str> = line.trim_end_matches('.').split('=').map(str::trim).collect();
            // A result may stand in a second unit.
            for pair in equal.windows(2) {
                let (Some(value), Some((own, half, _))) = (reckoned(pair[0]), number(pair[1])) else {
                    continue;
                };
                lines += 1;
                if (value - own).abs() > half * (1.0 + 1e-6) {
                    wrong.push(format!("{name}: {line} gives {value}"));
                }
            }
            let [of, symbols, numbers, result, ..] = equal[..] else { continue };
            let (symbols, numbers) = (parts(symbols), parts(numbers));
            if symbols.len() == numbers.len() {
                for (symbol, own) in symbols.iter().zip(&numbers) {
                    let (Some(before), Some((own, ..))) = (printed.get(symbol), number(own)) else {
                        continue;
                    };
                    uses += 1;
                    // In another unit it has the same figures.
                    let tens = libm::log10((own / before).abs());
                    if (tens - libm::round(tens)).abs() > 1e-9 {
                        wrong.push(format!("{name}: {line}, but {symbol} is {before}"));
                    }
                }
            }
            if let Some((value, ..)) = number(result) {
                printed.insert(of.to_owned(), value);
            }
        }
    }
    assert!(lines > 60 && uses > 40, "{lines} lines, {uses} uses");
    assert!(wrong.is_empty(), "{} of {lines}: {wrong:#?}", wrong.len());
}

/// What turns at another speed than the input has a name of its own, and so has its speed.
#[test]
fn the_ratio_of_what_turns_with_the_input_is_named() {
    let lines = told(&solution(&common::read(PRESS)));
    let line = lines.iter().find(|line| line.starts_with("I = ")).unwrap();
    assert_eq!(line, "I = I′ × (ω′/ω_2)² = 1.5 × 4² = 24 kg·m²");
}

const SHAPER: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [0, -120]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 46.8}, "4": {"joins": ["O4", "C"], "length": 205.2},
    "5": {"joins": ["C", "D"], "length": 120.1}}, "slides": [
    {"pin": "A", "block": 3, "on": {"link": 4, "through": "O4", "toward": "C"}},
    {"pin": "D", "block": 6, "on": {"link": 1, "through": [0, 90], "angle": 0}}],
    "near": {"C": [65, 90], "D": [-50, 90]}, "input": {"link": 2, "angle": 97, "omega": "293 rpm cw"}}"#;

const LEVER: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [0, -140]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 59.3}, "4": {"joins": ["O4", "B"], "length": 242.8}},
    "slides": [{"pin": "A", "block": 3, "on": {"link": 4, "through": "O4", "toward": "B"}}],
    "near": {"B": [60, 90]}, "input": {"link": 2, "angle": 217, "omega": "229 rpm ccw"}}"#;

/// ω of the lever in closed form: the pin A on the crank, seen from the pivot of the lever.
fn lever(crank: f64, below: f64, degrees: f64, omega: f64) -> f64 {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let [x, y] = [crank * cos, below + crank * sin];
    let [vx, vy] = [-crank * omega * sin, crank * omega * cos];
    (x * vy - y * vx) / (x * x + y * y)
}

/// The steps come to the third figure of what is true.
#[test]
fn readings_give_the_third_figure_of_a_rate() {
    let rate = |rpm: f64| rpm * std::f64::consts::TAU / 60.0;
    let cases =
        [(SHAPER, lever(46.8, 120.0, 97.0, -rate(293.0))), (LEVER, lever(59.3, 140.0, 217.0, rate(229.0)))];
    for (scene, truth) in cases {
        let lines = told(&solution(&common::read(scene)));
        let line = lines.iter().find(|line| line.starts_with("ω_4 = V")).unwrap();
        let own = value_of(line.rsplit('=').next().unwrap());
        assert_eq!(format!("{own:.2e}"), format!("{:.2e}", truth.abs()), "{line}");
    }
}

const RAIL: &str = r#"{"units": {"length": "in"}, "fixed": {"O2": [0, 0]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 1.7}, "3": {"joins": ["A", "B"], "length": 6.1}, "4": {"joins": ["B"]}},
    "rolls": [{"links": [1, 4], "line": {"link": 1, "through": [0, -2], "angle": 5}, "centre": "B", "radius": 1.5}],
    "near": {"B": [6, 0]}, "input": {"link": 2, "angle": 125, "omega": "70 rpm ccw", "alpha": "5 rad/s^2 cw"}}"#;

const GEARS: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [70, 60]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 18}, "3": {"joins": ["B"]}, "4": {"joins": ["O4", "B"], "length": 82}},
    "rolls": [{"links": [2, 3], "centres": ["A", "B"], "radii": [28, 16]}], "near": {"B": [10, 50]},
    "input": {"link": 2, "angle": 100, "omega": "150 rpm ccw"}}"#;

const RING: &str = r#"{"units": {"length": "mm"}, "fixed": {"O": [0, 0]}, "placed": {"B": [90, 143.92304845413264]},
    "links": {"2": {"joins": ["O", "A"], "length": 120}, "3": {"joins": ["A", "B"], "length": 50},
    "4": {"joins": ["B", "C"], "length": 360}},
    "slides": [{"pin": "C", "block": 5, "on": {"link": 1, "through": "O", "angle": 0}}],
    "rolls": [{"links": [1, 3], "centres": ["O", "A"], "radii": [200, 80], "internal": true}], "near": {"C": [430, 0]},
    "input": {"link": 2, "angle": 60, "omega": "180 rpm cw"}, "find": ["v(B)", "a(B)", "a(C)", "I(1,3)"]}"#;

/// A wheel on a rail has A = α r; of other contacts the reason is told why a line is drawn along the common normal.
#[test]
fn the_acceleration_of_a_wheel_has_its_reason() {
    let rail = common::read(RAIL);
    let lines = told(&solution(&rail));
    let reason =
        lines.iter().position(|line| line.starts_with("Link 4 rolls on a straight line at rest: B keeps"));
    let line = &lines[reason.unwrap() + 1];
    assert!(line.starts_with("α_4 = A_B / PB = "), "{line}");
    // A wheel of radius r that keeps to its rail.
    let construction = solved(&rail).solution.construction;
    let answer = |quantity: Quantity| {
        let index = rail.mechanism.asked.iter().position(|asked| asked.quantity == quantity).unwrap();
        match construction.answers[index].answer {
            Answer::Scalar { value, .. } => value.abs(),
            Answer::Vector { value: [x, y], .. } => libm::hypot(x, y),
            ref other => panic!("{other:?}"),
        }
    };
    let (centre, wheel) =
        (rail.mechanism.point_named("B").unwrap(), rail.mechanism.link_numbered(4).unwrap());
    let by_law = answer(Quantity::Acceleration(centre)) / (1.5 * 0.0254);
    assert!((answer(Quantity::Alpha(wheel)) - by_law).abs() < 1e-9 * by_law);
    for (name, scene) in [("gears", GEARS), ("ring", RING)] {
        let lines = told(&solution(&common::read(scene)));
        let along = lines.iter().position(|line| {
            line.starts_with("Through o′ draw a line ∥ AP")
                || line.starts_with("Through p′_2,1 draw a line ∥ BP")
        });
        let before = &lines[..along.unwrap_or_else(|| panic!("{name}: {lines:#?}"))];
        let told = before.iter().rev().take(3).any(|line| line.contains("the tangential parts are equal"));
        assert!(told, "{name}: {before:#?}");
    }
}

/// All pairs of the ring are seen, (15) of the slide at infinity among them.
#[test]
fn all_primary_centres_are_listed() {
    let lines = told(&solution(&common::read(RING)));
    let list = lines.iter().find(|line| line.starts_with("Primary centres")).unwrap();
    for centre in ["(12)", "(23)", "(13)", "(34)", "(45)", "(15)∞"] {
        assert!(list.replace("^∞", "∞").contains(centre), "{centre}: {list}");
    }
}

const BY_CENTRES: &str = r#"{"units": {"length": "cm"}, "fixed": {"O2": [0, 0], "O4": [34, 4]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 12}, "3": {"joins": ["A", "B", "C"], "sides": [30, 16, 24]},
    "4": {"joins": ["O4", "B"], "length": 20}}, "near": {"B": [32, 24], "C": [14, 34]},
    "input": {"link": 2, "angle": 70, "omega": "90 rpm cw"},
    "find": [{"name": "a(C)", "method": "centres"}, {"name": "alpha(4)", "method": "centres"}, "I(2,4)"]}"#;

/// What feeds accelerations from centres is derived: ω₃ by the common centre, then V = ω times its distance from the pole.
#[test]
fn velocities_by_centres_that_feed_accelerations_are_derived() {
    let lines = told(&solution(&common::read(BY_CENTRES)));
    let at = |beginning: &str| {
        let found = lines.iter().position(|line| line.contains(beginning));
        found.unwrap_or_else(|| panic!("{beginning} stands nowhere: {lines:#?}"))
    };
    let steps = [
        "N = 4 (4 − 1) / 2",
        "Measured: (12–23) = ",
        "ω_3 = ω_2 · (12–23) / (13–23)",
        "Measured: (13–B) = ",
        "V_B = ω_3 (13–B)",
        "Lay off V_B = ob",
        "A^n_B = V^2_B / O_4B",
    ];
    let order: Vec<usize> = steps.iter().map(|step| at(step)).collect();
    assert!(order.is_sorted(), "{order:?}");
    // The speed that is squared is the one that was told.
    let speed = value_of(lines[order[4]].split('=').nth(2).unwrap());
    let squared = lines[order[6]].split('=').nth(1).unwrap();
    let told = lines[order[4]].rsplit('=').next().unwrap().trim().split(' ').next().unwrap();
    assert!(lines[order[6]].contains(&format!("{told}²")), "{told}, {speed}: {squared}");
}

const BLOCK: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 50}, "3": {"joins": ["A", "B"], "length": 180}},
    "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": [0, 0], "angle": -20}}], "near": {"B": [200, -70]},
    "input": {"link": 2, "angle": 60, "omega": "30 rad/s cw", "alpha": 100}, "gravity": {},
    "masses": {"4": {"mass": 4, "at": [15, 20], "inertia": 0.004}}, "loads": [
    {"name": "P", "on": 4, "at": [30, 12], "force": [-400, 50], "in": 4}, {"name": "C", "on": 4, "torque": "3 N*m ccw"}],
    "find": ["T(2)", "F(1,4)", "moment(F(1,4),B)", "F(3,4)", "Fin(4)", "arm(F(1,4),B)"]}"#;

/// A couple shifts what the guide exerts: moments of the block about its pin place it.
#[test]
fn what_a_couple_shifts_is_placed_by_moments() {
    let scene = common::read(BLOCK);
    let lines = told(&solution(&scene));
    let moments = lines.iter().find(|line| line.starts_with("Moments of link 4 about B: M_B(F_14) = "));
    let moments = moments.unwrap_or_else(|| panic!("{lines:#?}"));
    let own = value_of(moments.rsplit('=').next().unwrap());
    // P and the couple as they are stated, the weight 20° off the block's own axes, the inertia force along the guide.
    let construction = solved(&scene).solution.construction;
    let inertia = scene.mechanism.asked.iter().zip(&construction.answers).nth(4).unwrap().1;
    let Answer::Vector { value: [x, y], .. } = inertia.answer else { panic!("no vector") };
    let (sin, cos) = libm::sincos((-20.0_f64).to_radians());
    let along = x * cos + y * sin;
    let arm = 0.015 * cos - 0.020 * sin;
    let sum = 0.030 * 50.0 + 0.012 * 400.0 + 3.0 - 4.0 * 9.81 * arm - 0.020 * along;
    assert!((own - sum.abs()).abs() < 5e-3, "{own}, by hand {sum}: {moments}");
    let arm = lines.iter().find(|line| line.starts_with("a_B(F_14) = ")).unwrap();
    assert!(arm.starts_with("a_B(F_14) = M_B(F_14) / F_14 = "), "{arm}");
}

/// Of every symbol of a question it is said what it is.
#[test]
fn questions_explain_their_symbols() {
    let governor = common::read(
        r#"{"units": {"length": "mm"}, "fixed": {"O": [0, 0]}, "placed": {"B": [150, -200], "S": [0, -400]},
        "links": {"2": {"joins": ["O", "B"]}, "3": {"joins": ["B", "S"]}},
        "slides": [{"pin": "S", "block": 4, "on": {"link": 1, "through": "O", "angle": 90}, "drag": 20}],
        "input": {"link": 2}, "gravity": {}, "masses": {"2": {"mass": 4, "at": "B"}, "4": {"mass": 24}},
        "spin": {"axis": {"through": [0, 0], "angle": 90}, "omega": "?", "balls": 2, "sleeve": 4},
        "find": ["spin(rising)", "spin(falling)"]}"#,
    );
    let text = question(&governor);
    assert!(text.contains("friction of the sleeve F_f = 20 N"), "{text}");
    assert!(text.contains("what acts on link 4 is given for the whole"), "{text}");
    let punch = common::read(
        r#"{"units": {"length": "mm", "torque": "N*m"}, "links": {}, "input": {"omega": "240 rpm"},
        "cycle": {"torque": {"harmonics": {"constant": 120, "sin": [[1, 85], [2, -60]], "cos": [[2, 35]]}},
        "rotating": [{"mass": 40, "gyration": "180 mm"}], "fluctuation": 0.02}, "find": ["Ef", "If"]}"#,
    );
    let text = question(&punch);
    for said in [
        "the load torque is constant",
        "period θ_C = 360°",
        "the coefficient of fluctuation of speed K_s = 0.02",
        "turning with the input: M = 40 kg, ρ = 180 mm",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let weighed = common::read(
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [300, -40]}, "links": {
        "2": {"joins": ["O2", "A"], "length": 90}, "3": {"joins": ["A", "B"], "length": 260},
        "4": {"joins": ["O4", "B"], "length": 200}}, "near": {"B": [290, 150]},
        "input": {"link": 2, "angle": 55, "omega": "180 rpm ccw"}, "gravity": {},
        "masses": {"3": {"mass": 4, "at": [130, 20], "inertia": 0.03}},
        "find": ["T(2)", "T(2).static", "T(2).inertia", "FS"]}"#,
    );
    let text = question(&weighed);
    for said in ["(from weights and loads alone)", "(from inertia alone)", "(shaking force)"] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let text = question(&common::read(LEVER));
    assert!(text.contains("A_2,A_3,A_4") || text.contains("A_2, A_3, A_4"), "{text}");
}

/// A point that one distance alone holds has a direction as well.
#[test]
fn one_distance_and_a_direction_mark_a_point() {
    let ram = common::read(
        r#"{"units": {"length": "cm"}, "fixed": {"O2": [0, 0], "O6": [50, -8]}, "links": {
        "2": {"joins": ["O2", "A"], "length": 12}, "3": {"joins": ["A", "B"], "length": 38},
        "4": {"joins": ["B", "T"], "shape": {"B": [0, 0], "T": [10, 9]}}, "5": {"joins": ["T", "S"], "length": 24},
        "6": {"joins": ["O6", "S"], "length": 16}},
        "slides": [{"link": 4, "on": {"link": 1, "through": [0, -4], "angle": 10}}],
        "near": {"B": [44, 4], "S": [70, -3]}, "input": {"link": 2, "angle": 140, "omega": "100 rpm cw"}}"#,
    );
    let lines = told(&solution(&ram));
    let mark = lines.iter().find(|line| line.starts_with("Mark T on link 4")).unwrap();
    // Its own axes lie along the guide.
    let angle = 10.0 + libm::atan2(9.0, 10.0).to_degrees();
    let near = |text: &str| (value_of(text) - angle).abs() < 0.05;
    let own = mark.split("and BT at ").nth(1).unwrap_or_else(|| panic!("{mark}"));
    assert!(near(own) && own.ends_with("° to the horizontal."), "{mark}");
    let slotted = common::read(
        r#"{"units": {"length": "in"}, "fixed": {"O2": [0, 0], "O4": [-6, 0]}, "links": {
        "2": {"joins": ["O2", "A"], "length": 1.5},
        "4": {"joins": ["O4", "Q"], "shape": {"O4": [0, 0], "Q": [8, 0]}}},
        "slides": [{"pin": "A", "block": 3, "on": {"link": 4, "centre": [6, -5], "radius": 5}}],
        "near": {"Q": [2, 1]}, "input": {"link": 2, "angle": 60, "omega": "120 rpm cw"}}"#,
    );
    let lines = told(&solution(&slotted));
    let mark = lines.iter().find(|line| line.starts_with("Mark Q on link 4")).unwrap();
    let angle = libm::atan2(5.0, 6.0).to_degrees();
    assert!(mark.contains(&format!("O_4Q stands {angle:.1}° ccw from the line to the centre")), "{mark}");
}

/// The normal parts at a contact set no scale: the joints of the rod stand apart on the paper.
#[test]
fn no_normal_part_of_a_contact_sets_the_scale() {
    let construction = solved(&common::read(RAIL)).solution.construction;
    let diagram = construction.diagram(DiagramKind::Acceleration).unwrap();
    let normal =
        |quantity: Quantity| matches!(quantity, Quantity::CoincidentNormal(..) | Quantity::ContactNormal(..));
    assert!(diagram.vectors.iter().all(|vector| !normal(vector.quantity)));
    let figure = solution(&common::read(RAIL));
    assert!(within(&figure.root).into_iter().any(|group| has(group, "acceleration")));
}

/// A length that is measured on paper is by the scale what stands there, with all of its figures: the lines that use it give the
/// speeds which the polygon shows.
#[test]
fn a_measured_radius_keeps_the_figures_that_were_read() {
    // At 75° the pole of the rod lies more than a metre off, and is not on the paper.
    for angle in [30, 40, 60, 75, 100] {
        let text = r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [24, 6] },
        "links": { "2": { "joins": ["O2", "A"], "length": 9 }, "3": { "joins": ["A", "B", "C"], "sides": [22, 9, 16], "turn": "cw" },
                   "4": { "joins": ["O4", "B"], "length": 14 } },
        "near": { "B": [20, -8], "C": [14, -14] }, "input": { "link": 2, "angle": ANGLE, "omega": "90 rpm cw", "alpha": 12 },
        "find": [{ "name": "v(B)", "method": "centres" }, { "name": "v(C)", "method": "centres" }, "a(C)"] }"#;
        let lines = told(&solution(&common::read(&text.replace("ANGLE", &angle.to_string()))));
        let mut measured = 0;
        for line in lines.iter().filter(|line| line.contains(" mm, that is ")) {
            for part in line.split("mm, that is ").skip(1).zip(line.split(" mm, that is ")) {
                let (after, before) = part;
                let mm = value_of(before.rsplit(' ').next().unwrap());
                let cm = value_of(after.split(' ').next().unwrap());
                // At 1 : 1, 2, 2.5 or 5, or tens of these, the product has few figures.
                let scale = cm / mm * 10.0;
                let tens = libm::floor(libm::log10(scale) + 1e-9);
                let digits = scale / libm::exp10(tens);
                let known = [1.0, 2.0, 2.5, 5.0].iter().any(|known| (digits - known).abs() < 1e-9);
                assert!(known, "{line}: {mm} mm times {scale}");
                measured += 1;
            }
        }
        let beyond = lines.iter().any(|line| line.contains("is not on the paper"));
        assert!(measured >= 3 || beyond, "{measured}: {lines:?}");
        assert_eq!(beyond, angle == 75, "{lines:?}");
    }
}

#[test]
fn whatever_is_laid_off_has_its_direction() {
    let mut vectors = 0;
    for stem in
        ["pairs/wheel-on-moving-plane", "pairs/wheel-in-ring", "pairs/rack-on-moving-guide", "s000-ch4-9-d"]
    {
        for line in told(&solution(&common::example(stem))).iter().filter(|line| line.starts_with("Lay off "))
        {
            assert!(!line.contains(", .") && !line.contains(" ,"), "{stem}: {line}");
            vectors += 1;
        }
    }
    assert!(vectors > 15, "{vectors}");
}

#[test]
fn given_areas_say_what_they_are() {
    let text = r#"{ "units": { "length": "mm" }, "links": {}, "input": { "omega": "300 rpm" },
        "cycle": { "torque": { "areas": [52, -124, 92, -140, 85, -72, 107], "scale": { "torque": 600, "angle": 3 } },
                   "fluctuation": 0.03 }, "find": ["Ef", "If"] }"#;
    let question = question(&common::read(text));
    for said in ["areas between the torque curve and the mean line", "1 mm² ≡ 600 N·m"] {
        assert!(question.contains(said), "{said}: {question}");
    }
}

/// A link that slides without turning is held at an angle to its guide, from which alone its other points can be drawn.
#[test]
fn the_angle_at_which_a_riding_link_is_held_is_given() {
    let scene = |turned: &str| {
        common::read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 40 }}, "3": {{ "joins": ["A", "D"], "length": 150 }},
                        "4": {{ "joins": ["B", "D"], "length": 60 }} }},
            "slides": [{{ "link": 4, "turned": {turned}, "on": {{ "link": 1, "through": [0, -10], "angle": 0 }} }}],
            "near": {{ "B": [110, -10] }}, "input": {{ "link": 2, "angle": 80, "omega": 5 }}, "find": ["v(B)"] }}"#
        ))
    };
    for (turned, told) in [("35", "BD at 35° ccw from guide"), ("-60", "BD at 60° cw from guide")] {
        let question = question(&scene(turned));
        assert!(question.contains(told), "{told}: {question}");
    }
}

#[test]
fn an_acceleration_is_laid_off_in_the_sense_of_alpha() {
    let text = common::example("pairs/driven-wheel").source.text().to_owned();
    let slowed = text.replace(r#""alpha": -4"#, r#""alpha": 4"#);
    for scene in [text, slowed] {
        let lines = told(&solution(&common::read(&scene)));
        let senses: Vec<&String> = lines.iter().filter(|line| line.contains("A_C = o")).collect();
        assert!(
            !senses.is_empty() && senses.iter().all(|line| line.contains("in the sense of α")),
            "{senses:?}"
        );
    }
}

/// A wheel that rolls on a line of a moving link is given with where that line lies, in the words of guides.
#[test]
fn a_rail_of_a_moving_link_is_given_with_its_place() {
    let scene = |line: &str| {
        common::read(&format!(
            r#"{{"units": {{"length": "mm"}}, "fixed": {{"O2": [0, 0], "O4": [150, 90]}}, "links": {{
            "2": {{"joins": ["O2", "A"], "length": 200}}, "3": {{"joins": ["O4", "C"], "length": 75}},
            "4": {{"joins": ["C"]}}}}, "rolls": [{{"links": [2, 4], "line": {{"link": 2, {line}}}, "centre": "C", "radius": 25}}],
            "near": {{"C": [100, 65]}}, "input": {{"link": 2, "angle": 0, "omega": "3 rad/s ccw"}},
            "find": ["v(C)", "omega(4)"]}}"#
        ))
    };
    for (line, told) in [
        (
            r#""through": [30, 15], "angle": 12"#,
            "rolls on the line of link 2 through its (30; 15) mm at 12° from O_2, x along O_2A",
        ),
        (
            r#""through": "O2", "toward": "A", "offset": 40"#,
            "rolls on the line O_2A of link 2 offset 40 mm to the left",
        ),
        (r#""through": "O2", "toward": "A", "turned": 8"#, "rolls on the line O_2A of link 2 turned by 8°"),
        (
            r#""through": "O2", "angle": 180, "offset": -40"#,
            "rolls on the line O_2A of link 2 turned by 180° offset 40 mm to the right",
        ),
        (r#""through": "O2", "toward": "A""#, "rolls on the line O_2A of link 2"),
    ] {
        let scene = scene(line);
        let lines = told_given(&scene);
        assert!(lines.contains(told), "{line}: {lines}");
        let question = question(&scene);
        assert!(question.contains(told), "{line}: {question}");
    }
}

/// All that stands on a solution, as one text with plain blanks.
fn told_given(scene: &Scene) -> String {
    let mut all = String::new();
    solution(scene).root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.push_str(&characters(text).replace(['\u{a0}', '\u{2009}'], " "));
            all.push(' ');
        }
    });
    all
}

/// ω from link to link is told with its construction: V of the known pin turned onto its line to the pole, the parallel that
/// finds the next pin's, and what the two lengths differ by.
#[test]
fn omega_from_link_to_link_has_its_construction() {
    for name in ["centres/offset-slider-crank", "centres/four-bar"] {
        let lines = told(&solution(&common::example(name)));
        let line = lines.iter().find(|line| line.contains(" differ by ") || line.contains(" lies against "));
        let Some(line) = line else { continue };
        let place = |part: &str| line.find(part).unwrap_or_else(|| panic!("{name}: no {part} in {line}"));
        let parts = [
            "Turn V_A by 90° onto the line from A to (",
            "The parallel to AB through it meets the line from B to (",
            "in B′",
            "A′B′ = ",
            "which is V_BA turned",
            "ω_3 = ",
        ];
        let places = parts.map(place);
        assert!(places.is_sorted(), "{name}: {line}");
    }
    let slider = told(&solution(&common::example("centres/offset-slider-crank")));
    assert!(slider.iter().any(|line| line.contains("which is V_BA turned")));
}

/// A level of energy has no more decimals than the coarser of what is added, and comes out of what stands there.
#[test]
fn a_level_of_energy_has_no_false_digits() {
    let places = |text: &str| {
        let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
        text[..end].split_once('.').map_or(0, |(_, after)| after.len())
    };
    let kind = |name: &str| {
        let kind = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == name).unwrap();
        common::read(kind.scene)
    };
    let mut scenes =
        vec![("turning-moment", kind("turning-moment")), ("flywheel", common::example("exam/flywheel"))];
    scenes.extend(
        [("press", PRESS), ("four copies", FOUR_COPIES), ("waves", WAVES)]
            .map(|(n, text)| (n, common::read(text))),
    );
    let (mut lines, mut wrong) = (0, Vec::new());
    for (name, scene) in scenes {
        for line in told(&solution(&scene)) {
            let equal: Vec<&str> = line.trim_end_matches('.').split('=').map(str::trim).collect();
            let [of, symbols, numbers, result] = equal[..] else { continue };
            if !of.starts_with("E_") || !symbols.contains(" + A_") && !symbols.contains("+ A_") {
                continue;
            }
            lines += 1;
            let summands: Vec<String> = parts(numbers);
            let least = summands.iter().map(|part| places(part.trim_start_matches('−'))).min().unwrap();
            let own = places(result.trim_start_matches('−'));
            let (value, half, _) = number(result).unwrap();
            let closes = (reckoned(numbers).unwrap() - value).abs() <= half * (1.0 + 1e-6);
            if own > least || !closes {
                wrong.push(format!("{name}: {line}"));
            }
        }
    }
    assert!(lines > 6, "{lines}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The question of a cycle that several copies make shows the curve of one, and says how many add up and how far apart.
#[test]
fn a_question_of_copies_shows_the_curve_of_one() {
    let scene = common::read(
        r#"{"links": {}, "input": {"omega": "500 rpm"}, "cycle": {
        "torque": {"table": [[0, 0], [40, 620], [180, 0], [360, 0]]}, "copies": {"number": 2, "shift": 180},
        "rotating": [{"inertia": 1.8}]}, "find": ["Tmean", "crossing(1)", "area(1)"]}"#,
    );
    let text = question(&scene);
    assert!(text.contains("2 such curves, 180° apart, add up"), "{text}");
    assert!(text.contains("the angle of the crossing of the torques"), "{text}");
    let figure = sheet::question(&scene, &solved(&scene).solution.construction, Language::English);
    let groups = within(&figure.root);
    let diagram = groups.iter().find(|group| has(group, "turning-moment")).unwrap();
    let told = |key: &str| {
        let found = diagram.data.iter().find(|(name, _)| *name == key);
        found.unwrap().1.parse::<f64>().unwrap()
    };
    let [scale, angle] = [told("scale"), told("radians-per-mm").to_degrees()];
    let curve = within(diagram).into_iter().find(|group| has(group, "curve")).unwrap();
    let Some(Node::Mark(mark)) = curve.children.first() else { panic!("no curve") };
    let linkgram::sheet::figure::Shape::Polyline(points) = &mark.shape else { panic!("no points") };
    // The corners of the table, as they are read off: the curve of one copy, not the sum.
    let begin = points[0];
    let read: Vec<[f64; 2]> =
        points.iter().map(|p| [(p.x - begin.x) * angle, (begin.y - p.y) * scale].map(libm::round)).collect();
    assert_eq!(read, [[0.0, 0.0], [40.0, 620.0], [180.0, 0.0], [360.0, 0.0]]);
}

/// One letter is one thing: where a load is called P the contact of a wheel is not.
#[test]
fn a_contact_and_a_load_have_two_letters() {
    let scene = common::read(
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]}, "links": {
        "2": {"joins": ["O2", "A"], "length": 40}, "3": {"joins": ["A", "C"], "length": 150}, "4": {"joins": ["C"]}},
        "rolls": [{"links": [1, 4], "line": {"link": 1, "through": [0, -50], "angle": 0}, "centre": "C", "radius": 50}],
        "near": {"C": [180, 0]}, "gravity": {}, "masses": {"4": {"mass": 20, "inertia": 0.025}},
        "input": {"link": 2, "angle": 50, "omega": "10 rad/s ccw"},
        "loads": [{"on": 4, "at": "C", "force": 60, "direction": 180, "name": "P"}], "find": ["T(2)", "F(1,4)"]}"#,
    );
    let lines = told(&solution(&scene));
    assert!(lines.iter().any(|line| line == "Mark the contact point Q."), "{lines:#?}");
    assert!(!lines.iter().any(|line| line.contains("point P")), "{lines:#?}");
    assert!(lines.iter().any(|line| line.contains("P · x")), "{lines:#?}");
}

/// Where a guide holds a link beside its pin, a line tells how far: the moment of its force over the force.
#[test]
fn a_displaced_reaction_has_its_distance_in_a_line() {
    let scene = common::read(
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]}, "links": {
        "2": {"joins": ["O2", "A"], "length": 50}, "3": {"joins": ["A", "B"], "length": 160},
        "4": {"joins": ["B", "H"], "shape": {"B": [0, 0], "H": [40, 60]}}},
        "slides": [{"link": 4, "on": {"link": 1, "through": [0, 20], "angle": 0}}], "near": {"B": [200, 20]},
        "gravity": {}, "masses": {"3": {"mass": 2.5, "at": [70, 0], "inertia": 0.006}, "4": {"mass": 5, "at": [20, 25]}},
        "loads": [{"on": 4, "at": "H", "force": 400, "direction": 180, "name": "P"}],
        "input": {"link": 2, "angle": 60, "omega": "15 rad/s ccw"}, "find": ["T(2)", "F(1,4)"]}"#,
    );
    let lines = told(&solution(&scene));
    let last = |line: &str| value_of(line.rsplit('=').next().unwrap());
    let line = lines.iter().find(|line| line.starts_with("The line of F_14 passes beside B: ")).unwrap();
    let moment = lines.iter().find(|line| line.starts_with("Moments of link 4 about B: M_B(F_14)")).unwrap();
    let force = lines.iter().find(|line| line.starts_with("Moments of links 3 and 4 about A: F_14")).unwrap();
    // N·m over N, in mm; three figures each.
    let own = 1000.0 * last(moment) / last(force);
    assert!((last(line) - own).abs() < 0.01 * own, "{line}, {moment}, {force}");
}

/// A body that nothing loads ends with its forces: they are zero.
#[test]
fn forces_on_a_body_without_load_are_said_to_be_zero() {
    let scene = common::read(
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]}, "links": {
        "2": {"joins": ["O2", "A"], "length": 60}, "3": {"joins": ["A", "B"], "length": 220}},
        "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": "O2"}}], "near": {"B": [260, 0]},
        "input": {"link": 2, "angle": 30, "omega": "120 rpm ccw"},
        "loads": [{"on": 4, "at": "B", "name": "K", "direction": 180,
            "force": {"table": [[0, 0], [90, 0], [150, 3000], [180, 0], [360, 0]]}}],
        "find": ["T(2)", "F(1,4)"]}"#,
    );
    let lines = told(&solution(&scene));
    for force in ["F_34", "F_14"] {
        assert!(lines.iter().any(|line| *line == format!("{force} is zero.")), "{force}: {lines:#?}");
    }
}
