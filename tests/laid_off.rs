//! What a sheet gives a student to lay off, and how it says it: the figure of a question carries what the scene states, given
//! numbers stand as their author wrote them, nothing given is measured, what cannot turn turns about nothing, and the
//! points of a link beyond its pins have equations of their own.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;
use crate::legibility::{has, within};

use linkgram::plan::Extent;
use linkgram::sheet::figure::{Node, Shape, Text};
use linkgram::sheet::{self, Figure, Language};

const RACK_ON_SLIDER: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O5": [130, 40]},
    "links": {"2": {"joins": ["O2", "A"], "length": 40}, "3": {"joins": ["A", "B"], "length": 120}, "4": {"joins": ["B"]},
    "5": {"joins": ["O5"]}}, "slides": [{"link": 4, "on": {"link": 1, "through": "O2"}}],
    "rolls": [{"links": [4, 5], "line": {"through": [0, 10]}, "centre": "O5", "radius": 30}], "near": {"B": [150, 0]},
    "input": {"link": 2, "angle": 60, "omega": "300 rpm ccw"}, "find": ["v(B)", "omega(5)", "a(B)", "alpha(5)"]}"#;

const BY_LOCI: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [90, -20]},
    "where": {"A": {"from": "O2", "distance": 40, "direction": 60},
    "B": [{"from": "A", "distance": 90}, {"from": "O4", "distance": 60}],
    "C": [{"from": "B", "square_to": ["A", "B"]}, {"from": "O4", "direction": 30}]},
    "links": {"2": {"joins": ["O2", "A"]}, "3": {"joins": ["A", "B", "C"]}, "4": {"joins": ["O4", "B"]}},
    "near": {"B": [110, 50], "C": [150, 20]}, "input": {"link": 2, "omega": "150 rpm ccw"},
    "find": ["v(B)", "omega(3)", "v(C)", "a(C)", "alpha(4)"]}"#;

const SHAPE_AND_GUIDES: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "G": [140, -30]},
    "links": {"2": {"joins": ["O2", "A"], "length": 40}, "3": {"joins": ["A", "B", "C"],
    "shape": {"A": [0, 0], "B": [110, 10], "C": [60, 45]}}, "5": {"joins": ["C", "D"], "length": 70}},
    "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": "G", "angle": 20, "offset": 8}},
    {"pin": "D", "block": 6, "on": {"link": 1, "through": [0, 120], "angle": -15}}],
    "near": {"B": [140, -20], "D": [20, 115]}, "input": {"link": 2, "angle": 60, "omega": "300 rpm ccw"},
    "find": ["v(B)", "omega(3)", "v(D)"]}"#;

const GEARS: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O3": [90, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 20}, "3": {"joins": ["O3", "B"], "length": 45}},
    "rolls": [{"links": [2, 3], "centres": ["O2", "O3"], "teeth": [15, 30], "module": 4}], "near": {"B": [90, 45]},
    "placed": {"B": [90, 45]}, "input": {"link": 2, "angle": 60, "omega": "300 rpm ccw"}, "find": ["omega(3)"]}"#;

const RADIANS: &str = r#"{"units": {"length": "mm", "angle": "rad"}, "fixed": {"O2": [0, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 50}, "3": {"joins": ["A", "B"], "length": 150}},
    "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": "O2", "offset": -20}}], "near": {"B": [165, -20]},
    "input": {"link": 2, "angle": 1.05, "omega": "450 rpm cw"},
    "loads": [{"name": "P", "on": 4, "force": "2 kN", "direction": 3.141592653589793}], "find": ["v(B)", "T(2)"]}"#;

/// Lengths in inches in a scene of feet, an angle of more than a turn, a triangle by its sides.
const OTHER_UNITS: &str = r#"{"units": {"length": "ft"}, "fixed": {"O2": [0, 0], "O4": [2, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": "9 in"}, "3": {"joins": ["A", "B", "E"], "sides": [1.75, 1, 1.25],
    "turn": "ccw"}, "4": {"joins": ["O4", "B"], "length": 1.5}},
    "near": {"B": [1.8, 1.4]}, "input": {"link": 2, "angle": 430, "omega": "60 rpm ccw"}, "find": ["omega(3)", "v(E)"]}"#;

fn drawn(text: &str, question: bool) -> Figure {
    let scene = common::read(text);
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let construction = &solved.solution.construction;
    match question {
        true => sheet::question(&scene, construction, Language::English),
        false => sheet::solution(&scene, construction, Language::English),
    }
}

/// What stands there, with plain blanks.
fn characters(text: &Text) -> String {
    text.runs.iter().map(|run| run.text.replace(['\u{a0}', '\u{2009}'], " ")).collect()
}

/// All texts of a figure, one after the other, with plain blanks.
fn told(figure: &Figure) -> String {
    let mut all = String::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.push_str(&characters(text));
            all.push(' ');
        }
    });
    all
}

/// The texts of the dimensions of a question's skeleton.
fn dimensions(figure: &Figure) -> Vec<String> {
    let mut all = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node
            && text.class.split(' ').any(|class| class == "dimension")
        {
            all.push(characters(text));
        }
    });
    all
}

fn has_class(figure: &Figure, wanted: &str) -> usize {
    let mut count = 0;
    figure.root.walk(&mut |node| {
        if let Node::Mark(mark) = node {
            count += usize::from(mark.class.split(' ').any(|class| class == wanted));
        }
    });
    count
}

#[test]
fn a_link_that_slides_turns_about_nothing() {
    let told = told(&drawn(RACK_ON_SLIDER, false));
    assert!(told.contains("Link 4 only translates: ω4 = 0."), "{told}");
    assert!(told.contains("Link 4 only translates: α4 = 0."), "{told}");
    assert!(!told.contains("0²") && !told.contains("ω4 ·"), "{told}");
}

/// From the block at B to the rack runs a bar.
#[test]
fn a_rack_hangs_on_its_block() {
    let figure = drawn(RACK_ON_SLIDER, false);
    let rolls = within(&figure.root).into_iter().filter(|group| has(group, "pitch-circles"));
    let nodes = rolls.flat_map(|group| &group.children);
    let bar = |node: &&Node| match node {
        Node::Mark(mark) => {
            mark.class == "bar" && matches!(mark.shape, Shape::Line(a, b) if a.distance(b) > 1.0)
        }
        _ => false,
    };
    assert_eq!(nodes.filter(bar).count(), 1);
}

#[test]
fn what_a_figure_states_is_dimensioned_and_not_measured() {
    let question = drawn(BY_LOCI, true);
    let dimensions = dimensions(&question);
    for wanted in ["40", "90", "60", "60°", "30°", "20"] {
        assert!(dimensions.iter().any(|own| own == wanted), "{wanted}: {dimensions:?}");
    }
    assert!(has_class(&question, "right-angle") >= 1);
    let told = told(&drawn(BY_LOCI, false));
    assert!(!told.contains("Measured: O2A") && !told.contains("Measured: AB"), "{told}");
}

#[test]
fn shapes_and_oblique_guides_are_dimensioned() {
    let dimensions = dimensions(&drawn(SHAPE_AND_GUIDES, true));
    for wanted in ["110", "10", "60", "45", "8", "20°", "15°", "120"] {
        assert!(dimensions.iter().any(|own| own == wanted), "{wanted}: {dimensions:?}");
    }
}

#[test]
fn gears_are_given_by_their_teeth() {
    let question = drawn(GEARS, true);
    let told = told(&question);
    assert!(told.contains("z = 15 and 30"), "{told}");
    assert!(told.contains("module 4 mm"), "{told}");
    let dimensions = dimensions(&question);
    assert!(["z = 15", "z = 30"].iter().all(|z| dimensions.iter().any(|own| own == z)), "{dimensions:?}");
}

/// 1.05 rad are 60.1606°; the offset guide lies 20 mm below O2.
#[test]
fn given_numbers_stand_as_they_are_written() {
    let told = told(&drawn(RADIANS, true));
    assert!(told.contains("1.05 rad (60.16°)"), "{told}");
    assert!(told.contains("2 kN"), "{told}");
    assert!(told.contains("20 mm below O2"), "{told}");
    let told = self::told(&drawn(RADIANS, false));
    assert!(told.contains("20 mm (") && told.contains("below O2"), "{told}");
}

/// V_C = V_A + V_CA = V_B + V_CB, and the same of accelerations with the normal and tangential parts.
#[test]
fn a_further_point_has_its_equation() {
    let scene = common::read(BY_LOCI);
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let names: Vec<Vec<String>> = solved
        .solution
        .construction
        .steps
        .iter()
        .flat_map(|step| &step.equations)
        .filter(|equation| equation.whole.is_some())
        .map(|equation| equation.terms().map(|term| term.quantity.name(&scene.mechanism)).collect())
        .collect();
    assert_eq!(
        names,
        [
            vec!["v(C)", "v(A)", "v(C/A)", "v(B)", "v(C/B)"],
            vec!["a(C)", "a(A)", "an(C/A)", "at(C/A)", "a(B)", "an(C/B)", "at(C/B)"],
        ]
    );
}

/// Without the stated scale the sheet is on A4; at 5 : 1 the crank alone is 200 mm long and the rod 600 mm.
#[test]
fn scales_that_need_larger_paper_say_so() {
    let text = RACK_ON_SLIDER.replacen('{', "{\"sheet\": {\"scales\": {\"length\": \"5:1\"}}, ", 1);
    let scene = common::read(&text);
    let figure = sheet::outgrown(drawn(&text, false), sheet::paper(&scene), Language::English);
    assert!(sheet::larger_paper(&figure, sheet::paper(&scene)).is_some_and(|[width, _]| width > 600.0));
    assert!(told(&figure).contains("The stated scales need paper of"));
    let plain = drawn(RACK_ON_SLIDER, false);
    assert_eq!(sheet::larger_paper(&plain, sheet::paper(&scene)), None);
}

/// An inclined guide 30 mm beside a pivot, and an arc about a place that no point marks.
#[test]
fn guides_beside_places_and_arcs_can_be_drawn() {
    let slider = |guide: &str| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "fixed": {{"O2": [0, 0]}}, "links": {{"2": {{"joins": ["O2", "A"], "length": 40}},
            "3": {{"joins": ["A", "B"], "length": 150}}}}, "slides": [{{"pin": "B", "block": 4, "on": {guide}}}],
            "near": {{"B": [150, -20]}}, "input": {{"link": 2, "angle": 60, "omega": "10 rad/s ccw"}}, "find": ["v(B)", "a(B)"]}}"#
        )
    };
    let inclined = slider(r#"{"link": 1, "through": "O2", "angle": -25, "offset": 30}"#);
    let told = told(&drawn(&inclined, false));
    assert!(told.contains("above O2"), "{told}");
    let shown = dimensions(&drawn(&inclined, true));
    assert!(["25°", "30"].iter().all(|own| shown.iter().any(|shown| shown == own)), "{shown:?}");
    let arc = slider(r#"{"link": 1, "centre": [140, -60], "radius": 50}"#);
    let shown = dimensions(&drawn(&arc, true));
    assert!(["140", "60", "R 50"].iter().all(|own| shown.iter().any(|s| s == own)), "{shown:?}");
    let told = self::told(&drawn(&arc, false));
    assert!(told.contains("toward the centre of the arc"), "{told}");
}

/// A number stands as its author wrote it, with what the steps compute with beside it; a drawing board has no more than a turn.
#[test]
fn a_length_in_another_unit_and_more_than_a_turn_stand_as_they_are_written() {
    for question in [true, false] {
        let told = told(&drawn(OTHER_UNITS, question));
        assert!(told.contains("O2A = 9 in = 0.75 ft"), "{told}");
        assert!(told.contains("θ2 = 430° = 360° + 70°"), "{told}");
        assert!(told.contains("triangle ABE, lettered counter-clockwise"), "{told}");
        assert!(question || told.contains("at 70°"), "{told}");
    }
    for (stated, told_as) in [("1500", "θ2 = 1500° = 4 × 360° + 60°"), ("-430", "θ2 = −430° = −360° − 70°")]
    {
        let text = OTHER_UNITS.replace("430", stated).replace("[1.8, 1.4]", "[1.8, -1.4]");
        let near = if stated == "1500" { text.replace("-1.4", "1.4") } else { text };
        let told = told(&drawn(&near, true));
        assert!(told.contains(told_as), "{told}");
    }
}
