//! Forces whose lines lie far off, or nowhere: their figures stay on the paper, and what is told of them is so.

#![allow(clippy::unwrap_used, reason = "a test")]

use linkgram::drawing::{self, Kind, Wish};
use linkgram::render::{Format, Options};
use linkgram::sheet::figure::{Figure, Group, Node};

fn sheet(text: &str) -> Figure {
    let scene = linkgram::scene::read(text, "scene.json").unwrap_or_else(|error| panic!("{error}"));
    let wish = Wish { kind: Kind::Solution, ..Wish::default() };
    drawing::figure(&scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(&scene)))
}

fn words(group: &Group, all: &mut String) {
    for child in &group.children {
        match child {
            Node::Group(group) => words(group, all),
            Node::Text(text) => {
                all.push_str(&text.content().split_whitespace().collect::<Vec<_>>().join(" "));
                all.push('\n');
            }
            Node::Mark(_) => {}
        }
    }
}

fn told(figure: &Figure) -> String {
    let mut all = String::new();
    words(&figure.root, &mut all);
    all
}

/// The widths and heights of the groups of these classes.
fn sizes(group: &Group, classes: &[&str], all: &mut Vec<[f64; 2]>) {
    if classes.contains(&group.class.as_str()) {
        all.extend(group.bounds().map(|bounds| [bounds.width(), bounds.height()]));
    }
    for child in &group.children {
        if let Node::Group(group) = child {
            sizes(group, classes, all);
        }
    }
}

/// A Scotch yoke: crank 60 mm at 40°, 200 N against the yoke, its mass at Y.
fn yoke(gravity: &str, find: &str) -> String {
    format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "4": {{ "joins": ["Y"] }} }},
        "slides": [ {{ "pin": "A", "block": 3, "on": {{ "link": 4, "through": [-30, 0], "angle": 90 }} }},
                    {{ "link": 4, "on": {{ "link": 1, "through": "O2" }} }} ],
        "near": {{ "Y": [76, 0] }}, "input": {{ "link": 2, "angle": 40, "omega": 10 }}, {gravity}
        "masses": {{ "4": {{ "mass": 5 }} }}, "loads": [ {{ "name": "Q", "on": 4, "force": 200, "direction": "against" }} ],
        "find": {find} }}"#
    )
}

/// A guide gives a couple of F34 by the height of A, and a force of 5 N whose line lies that couple over 5 N off.
#[test]
fn a_far_line_stays_on_the_paper_with_its_distance() {
    let figure =
        sheet(&yoke(r#""gravity": { "g": "1 m/s^2" },"#, r#"["T(2)", "F(1,4)", "moment(F(1,4),Y)"]"#));
    let mut all = Vec::new();
    sizes(&figure.root, &["free-body", "forces"], &mut all);
    assert!(all.len() > 3, "{all:?}");
    assert!(all.iter().all(|[width, height]| *width < 230.0 && *height < 230.0), "{all:?}");
    // x_Y = 60 cos ωt: inertia 5 kg × 6 m/s² × cos 40°, against the acceleration, which is toward O2.
    let (sin, cos) = libm::sincos(40_f64.to_radians());
    let push = 200.0 + 5.0 * 6.0 * cos;
    let couple = push * 0.06 * sin;
    let off = libm::round(couple / 5.0 * 1e3);
    let text = told(&figure);
    assert!(text.lines().any(|line| line == format!("{off} mm")), "{off}: {text}");
}

/// Without weight nothing but the couple is left: its moment about every point is the same, and it has no arm.
#[test]
fn a_couple_is_told_as_one() {
    let figure = sheet(&yoke("", r#"["T(2)", "F(1,4)", "moment(F(1,4),Y)", "moment(F(1,4),O2)", "F(3,4)"]"#));
    let text = told(&figure).replace('\n', " ");
    assert!(text.contains("what is left is a couple, whose moment about every point is 8."), "{text}");
    // No arm of 6 × 10¹⁷ mm.
    assert!(!text.contains("× 101"), "{text}");
    let mut all = Vec::new();
    sizes(&figure.root, &["free-body", "forces"], &mut all);
    assert!(all.iter().flatten().all(|size| size.is_finite() && *size < 230.0), "{all:?}");
    linkgram::render::render(&figure, Format::Png, &Options::default()).unwrap();
}

/// Springs that push, or that turn their second link clockwise: a size in the sense in which it acts, never a size below zero
/// behind a sign.
#[test]
fn springs_are_told_by_size_and_sense() {
    for (free, more) in [(20.0, ""), (-30.0, ""), (200.0, ""), (-30.0, r#", "spring(k)", "spring(s)""#)] {
        let scene = format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [200, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "3": {{ "joins": ["A", "B"], "length": 180 }},
                        "4": {{ "joins": ["O4", "B"], "length": 120 }} }},
            "near": {{ "B": [100, 67] }}, "input": {{ "link": 2, "angle": 200, "omega": 5 }},
            "springs": [ {{ "name": "k", "links": [3, 4], "stiffness": "8 N*m/rad", "free": {free} }},
                {{ "name": "s", "between": [ {{ "link": 3, "at": [90, 40] }}, {{ "link": 4, "at": [50, -30] }} ],
                   "stiffness": 900, "free": 250 }} ],
            "find": ["T(2)", "F(2,3)", "F(3,4)", "F(1,4)"{more}] }}"#
        );
        let text = told(&sheet(&scene)).replace('\n', " ");
        let bare: String = text.chars().filter(|c| !c.is_whitespace() && *c != '\u{2009}').collect();
        for wrong in ["+−", "−−", "✓−", "(−−"] {
            assert!(!bare.contains(wrong), "{wrong} with {free}: {text}");
        }
        if free < 0.0 {
            assert!(
                bare.contains("−0.524)") || bare.contains("(−0.524") || bare.contains("+0.524)"),
                "{text}"
            );
        }
    }
}

/// An Oldham coupling turns both shafts alike: 25 N·m against the one that is driven need 25 N·m at the other. Nothing else
/// passes than this couple, on each of the three links by an arc, turned round from one to the next.
#[test]
fn a_couple_passes_from_link_to_link() {
    let figure = sheet(include_str!("derived/oldham-couple.json"));
    let text = told(&figure).replace('\n', " ");
    assert!(text.contains("T2 = MC(F32) = 25 N·m ccw."), "{text}");
    assert!(!text.contains("Only two forces act on link 3"), "{text}");
    let svg = linkgram::render::render(&figure, Format::Svg, &Options::default()).unwrap();
    let svg = String::from_utf8(svg).unwrap();
    for (quantity, value) in [
        ("moment(F(3,4),O4)", "25"),
        ("moment(F(4,3),O4)", "-25"),
        ("moment(F(2,3),C)", "25"),
        ("moment(F(3,2),C)", "-25"),
    ] {
        let arc = format!(r#"data-quantity="{quantity}" data-value="{value}""#);
        assert!(svg.contains(&arc), "{arc}");
    }
}

/// A couple has no arm: where nothing else is asked there is no figure of arms.
#[test]
fn no_figure_of_arms_stands_without_an_arm() {
    let text = told(&sheet(include_str!("derived/yoke-couple.json"))).replace('\n', " ");
    assert!(
        text.contains("F14 is zero: what is left is a couple, whose moment about every point is 2.0"),
        "{text}"
    );
    assert!(!text.contains("Arms of forces, scale"), "{text}");
}
