//! Groups of every make: both solvers agree, and closed forms agree with both.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use std::f64::consts::PI;

use common::Drawn;
use linkgram::check::agreement;
use linkgram::plan::Extent;
use linkgram::{sheet, solve};

/// Draws a scene, and has the other solver confirm every number of it.
fn confirmed(text: &str) -> Drawn {
    let scene = common::read(text);
    let solved = solve::solve(&scene, Extent::Asked, sheet::scale::for_scene);
    let solved = solved.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let agreement = agreement(&scene, &solved, &solve::solve_analytically(&scene));
    let (refused, branch) = (&agreement.refused, &agreement.elsewhere);
    assert!(agreement.ok(), "{refused:?} {branch:?} {}\n{text}", agreement.worst_ratio());
    common::draw(&scene)
}

fn near_enough(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{found} instead of {expected}");
}

fn vector(drawn: &Drawn, name: &str, expected: [f64; 2]) {
    let (found, _) = drawn.vector(name);
    for axis in 0..2 {
        near_enough(found[axis], expected[axis]);
    }
}

/// First and second derivative of a motion at time 0, by differences of high order.
fn rates(motion: impl Fn(f64) -> f64) -> (f64, f64) {
    let h = 1e-3;
    let f = |k: i32| motion(f64::from(k) * h);
    let first = ((f(1) - f(-1)) * 45.0 - (f(2) - f(-2)) * 9.0 + (f(3) - f(-3))) / (60.0 * h);
    let second = (270.0 * (f(1) + f(-1)) - 27.0 * (f(2) + f(-2)) + 2.0 * (f(3) + f(-3)) - 490.0 * f(0))
        / (180.0 * h * h);
    (first, second)
}

/// A bare pin on a line of the frame, driven along it: `slides` without a block, on no link.
#[test]
fn a_driven_bare_pin_is_found_and_leads_a_rod() {
    let drawn = confirmed(
        r#"{
          "fixed": { "O": [0, 0] },
          "links": {
            "2": { "joins": ["P", "B"], "length": 2 },
            "3": { "joins": ["O", "B"], "length": 1.5 }
          },
          "slides": [ { "pin": "P", "on": { "link": 1, "through": [0, -3], "angle": 90 } } ],
          "near": { "P": [0, -1.8], "B": [1.5, -0.4] },
          "input": { "slide": "P", "at": 1.2, "velocity": 0.7, "acceleration": 0.3 },
          "find": ["x(P)", "v(P)", "a(P)", "v(B)", "a(B)", "omega(3)", "alpha(3)"]
        }"#,
    );
    vector(&drawn, "x(P)", [0.0, -1.8]);
    vector(&drawn, "v(P)", [0.0, 0.7]);
    vector(&drawn, "a(P)", [0.0, 0.3]);
    // P at height y, O at 0: y² + 1.5² − 2·1.5·y·sin θ = 2².
    let angle = |t: f64| {
        let y = -1.8 + 0.7 * t + 0.15 * t * t;
        libm::asin((y * y + 1.5 * 1.5 - 4.0) / (3.0 * y))
    };
    let (omega, alpha) = rates(angle);
    near_to(drawn.scalar("omega(3)").0, omega);
    near_to(drawn.scalar("alpha(3)").0, alpha);
}

/// As near as differences come.
fn near_to(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-6 * (1.0 + expected.abs()), "{found} instead of {expected}");
}

/// A bare pin of no link, in the slot of a crank and on a line of the frame: x = 2, y = 2 tan θ.
#[test]
fn a_bare_pin_on_two_guides_leads_a_rod() {
    let drawn = confirmed(
        r#"{
          "fixed": { "O": [0, 0], "Q": [5, 1] },
          "links": {
            "2": { "joins": ["O", "A"], "length": 1 },
            "3": { "joins": ["P", "B"], "length": 2 },
            "4": { "joins": ["Q", "B"], "length": 2.5 }
          },
          "slides": [
            { "pin": "P", "on": { "link": 2, "through": "O", "angle": 0 } },
            { "pin": "P", "on": { "link": 1, "through": [2, 0], "angle": 90 } }
          ],
          "near": { "P": [2, 0.7], "B": [4, 2.8] },
          "input": { "link": 2, "angle": 20, "omega": 3, "alpha": 1 },
          "find": ["x(P)", "v(P)", "a(P)", "v(B)", "a(B)", "slip(P/2)", "omega(4)", "alpha(4)"]
        }"#,
    );
    let height = |t: f64| 2.0 * libm::tan(20.0 * PI / 180.0 + 3.0 * t + 0.5 * t * t);
    let (speed, acceleration) = rates(height);
    vector(&drawn, "x(P)", [2.0, height(0.0)]);
    near_to(drawn.vector("v(P)").0[1], speed);
    near_to(drawn.vector("a(P)").0[1], acceleration);
}

/// A bare pin that is driven along a crank's own slot: r = 0.8 + 0.4 t − 0.1 t², θ = 20° + 3 t + t²/2.
#[test]
fn a_bare_pin_driven_along_a_turning_slot() {
    let drawn = confirmed(
        r#"{
          "fixed": { "O": [0, 0], "Q": [3, 1] },
          "links": {
            "2": { "joins": ["O", "A"], "length": 1 },
            "3": { "joins": ["P", "B"], "length": 2 },
            "4": { "joins": ["Q", "B"], "length": 2.5 }
          },
          "slides": [ { "pin": "P", "on": { "link": 2, "through": "O", "angle": 0 } } ],
          "near": { "P": [0.7, 0.3], "B": [1.2, 2.2] },
          "inputs": [
            { "link": 2, "angle": 20, "omega": 3, "alpha": 1 },
            { "slide": "P", "at": 0.8, "velocity": 0.4, "acceleration": -0.2 }
          ],
          "find": ["x(P)", "v(P)", "a(P)", "slip(P/2)", "coriolis(P/2)", "aslip(P/2)", "a(B)"]
        }"#,
    );
    let at = |t: f64| {
        let (r, angle) = (0.8 + 0.4 * t - 0.1 * t * t, 20.0 * PI / 180.0 + 3.0 * t + 0.5 * t * t);
        [r * libm::cos(angle), r * libm::sin(angle)]
    };
    for axis in 0..2 {
        let (speed, acceleration) = rates(|t| at(t)[axis]);
        near_to(drawn.vector("v(P)").0[axis], speed);
        near_to(drawn.vector("a(P)").0[axis], acceleration);
    }
}

/// A bare pin in the slot of a link that only translates, and on a line of the frame.
#[test]
fn a_bare_pin_in_the_slot_of_a_link_that_only_translates() {
    let drawn = confirmed(
        r#"{
          "fixed": { "O": [0, 0] },
          "links": { "2": { "joins": ["A"] }, "3": { "joins": ["P", "B"], "length": 2 } },
          "slides": [
            { "link": 2, "on": { "link": 1, "through": [0, 0], "angle": 0 } },
            { "pin": "P", "on": { "link": 2, "through": "A", "angle": 45 } },
            { "pin": "P", "on": { "link": 1, "through": [0, 1], "angle": 0 } },
            { "pin": "B", "on": { "link": 1, "through": [0, 0], "angle": 0 } }
          ],
          "near": { "P": [1.8, 1], "B": [3.5, 0] },
          "input": { "slide": 2, "at": 0.8, "velocity": 0.4, "acceleration": -0.2 },
          "find": ["x(P)", "v(P)", "a(P)", "slip(P/2)"]
        }"#,
    );
    vector(&drawn, "x(P)", [1.8, 1.0]);
    vector(&drawn, "v(P)", [0.4, 0.0]);
    vector(&drawn, "a(P)", [-0.2, 0.0]);
    vector(&drawn, "slip(P/2)", [0.0, 0.0]);
}

/// Two Oldham couplings in series, told by places or by dimensions: lever 4 is driven about I; 3 slides along it and across
/// 9, 9 along lever 2 about A and across lever 8 about E, and all turn as one.
fn oldham_in_series(angle: f64, places: Option<&[(&str, [f64; 2])]>) -> String {
    let (known, length, turned) = match places {
        Some(places) => {
            let all: Vec<String> =
                places.iter().map(|(name, [x, y])| format!(r#""{name}": [{x}, {y}]"#)).collect();
            (format!(r#""placed": {{ {} }}"#, all.join(", ")), "", ["", ""])
        }
        None => (
            r#""near": { "F": [1.6, 0.8], "K": [2, -1.5] }"#.to_owned(),
            r#", "length": 1"#,
            [r#""turned": 0,"#, r#""turned": -90,"#],
        ),
    };
    let [even, square] = turned;
    format!(
        r#"{{
          "fixed": {{ "A": [0, 0], "E": [2, 0], "I": [1, -2] }}, {known},
          "links": {{
            "2": {{ "joins": ["A", "P"]{length} }},
            "3": {{ "joins": ["K", "L"]{length} }},
            "4": {{ "joins": ["I", "S"]{length} }},
            "8": {{ "joins": ["E", "Q"]{length} }},
            "9": {{ "joins": ["F", "G"]{length} }}
          }},
          "slides": [
            {{ "link": 9, {even} "on": {{ "link": 2, "through": "A", "toward": "P" }} }},
            {{ "link": 9, {square} "on": {{ "link": 8, "through": "E", "toward": "Q", "turned": 90 }} }},
            {{ "link": 3, {square} "on": {{ "link": 9, "through": "F", "toward": "G", "turned": 90 }} }},
            {{ "link": 3, {even} "on": {{ "link": 4, "through": "I", "toward": "S" }} }}
          ],
          "input": {{ "link": 4, "angle": {angle}, "omega": 3, "alpha": -2 }},
          "find": ["x(F)", "v(F)", "a(F)", "x(K)", "v(K)", "a(K)", "x(P)", "v(L)", "omega(2)", "alpha(8)"]
        }}"#
    )
}

/// F sees A and E at a right angle and runs on the circle about their middle, twice as fast as the levers turn; K is the foot
/// of F on the line of the driven lever.
#[test]
fn oldham_couplings_in_series() {
    let start = 25.0_f64;
    let angle = |t: f64| start.to_radians() + 3.0 * t - t * t;
    let along = |t: f64| [libm::cos(angle(t)), libm::sin(angle(t))];
    let f = |t: f64| [1.0 + libm::cos(2.0 * angle(t)), libm::sin(2.0 * angle(t))];
    let k = |t: f64| {
        let ([x, y], [c, s]) = (f(t), along(t));
        let part = (x - 1.0) * c + (y + 2.0) * s;
        [1.0 + part * c, -2.0 + part * s]
    };
    let l = |t: f64| [0, 1].map(|axis| k(t)[axis] + along(t)[axis]);
    let beside = |[x, y]: [f64; 2]| [x + along(0.0)[0], y + along(0.0)[1]];
    let places = [
        ("F", f(0.0)),
        ("G", beside(f(0.0))),
        ("K", k(0.0)),
        ("L", l(0.0)),
        ("P", beside([0.0, 0.0])),
        ("Q", beside([2.0, 0.0])),
        ("S", beside([1.0, -2.0])),
    ];
    for places in [Some(&places[..]), None] {
        let drawn = confirmed(&oldham_in_series(start, places));
        vector(&drawn, "x(F)", f(0.0));
        vector(&drawn, "x(K)", k(0.0));
        vector(&drawn, "x(P)", along(0.0));
        for axis in 0..2 {
            let of_f = rates(|t| f(t)[axis]);
            near_to(drawn.vector("v(F)").0[axis], of_f.0);
            near_to(drawn.vector("a(F)").0[axis], of_f.1);
            let of_k = rates(|t| k(t)[axis]);
            near_to(drawn.vector("v(K)").0[axis], of_k.0);
            near_to(drawn.vector("a(K)").0[axis], of_k.1);
            near_to(drawn.vector("v(L)").0[axis], rates(|t| l(t)[axis]).0);
        }
        near_enough(drawn.scalar("omega(2)").0, 3.0);
        near_enough(drawn.scalar("alpha(8)").0, -2.0);
    }
}

/// A rack on a pinion about C, its contact at the origin, its line along x and its pin B at a height of 2 above it; what
/// holds or drives it besides, and the joint D of the pinion.
fn rack_above_a_pinion(links: &str, inputs: &str, find: &str) -> String {
    format!(
        r#"{{
          "fixed": {{ "A": [3, 0.5], "C": [0, -1] }},
          "placed": {{ "B": [0, 2], "E": [1.5, 2.5], "D": [-0.5, -1] }},
          "links": {{ {links}
            "3": {{ "joins": ["B", "E"] }},
            "4": {{ "joins": ["C", "D"] }}
          }},
          "rolls": [ {{ "links": [3, 4], "line": {{ "link": 3, "through": [0, 0], "angle": 0 }}, "centre": "C", "radius": 1 }} ],
          "inputs": [ {inputs} ],
          "find": [{find}]
        }}"#
    )
}

/// The pin of a rack stands square above its contact with the pinion that drives it: the crank rests there, and turning it
/// would not tell how the rack turns. With ω of the pinion, its radius 1 and the height 2: V_B = 0, so that ω₃ = −ω/2; the
/// contact of the rack has A = ω₃² − 2 ω₃ ω towards the pin, A_B = (−ε − 2 ε₃, ω₃² − 2 ω₃ ω − 2 ω₃²) is square to AB = (−3, 1.5).
#[test]
fn a_rack_whose_pin_stands_above_the_contact_is_driven_by_its_pinion() {
    let drawn = confirmed(&rack_above_a_pinion(
        r#""2": { "joins": ["A", "B"] },"#,
        r#"{ "link": 4, "omega": 2, "alpha": 1 }"#,
        r#""omega(2)", "omega(3)", "alpha(2)", "alpha(3)", "v(B)", "v(E)", "a(B)", "a(E)""#,
    ));
    near_enough(drawn.scalar("omega(2)").0, 0.0);
    near_enough(drawn.scalar("omega(3)").0, -1.0);
    near_enough(drawn.scalar("alpha(2)").0, -1.0);
    near_enough(drawn.scalar("alpha(3)").0, -1.25);
    vector(&drawn, "v(B)", [0.0, 0.0]);
    vector(&drawn, "v(E)", [0.5, -1.5]);
    vector(&drawn, "a(B)", [1.5, 3.0]);
    vector(&drawn, "a(E)", [1.5 + 1.25 * 0.5 - 1.5, 3.0 - 1.25 * 1.5 - 0.5]);
}

/// The same rack without a crank, driven itself: every point of it turns about the contact.
#[test]
fn a_driven_rack_rolls_on_a_driven_pinion() {
    for stated in [r#""omega": 3, "alpha": -2"#, r#""angle": 18.43494882292201, "omega": 3, "alpha": -2"#] {
        let inputs = format!(r#"{{ "link": 4, "omega": 2, "alpha": 1 }}, {{ "link": 3, {stated} }}"#);
        let find = r#""v(B)", "v(E)", "a(B)", "a(E)""#;
        let drawn = confirmed(&rack_above_a_pinion("", &inputs, find));
        vector(&drawn, "v(B)", [-2.0 - 6.0, 0.0]);
        vector(&drawn, "v(E)", [-2.0 - 7.5, 4.5]);
        // The contact of the rack: (−ε, ω₃² − 2 ω₃ ω) = (−1, −3).
        vector(&drawn, "a(B)", [-1.0 + 4.0, -3.0 - 18.0]);
        vector(&drawn, "a(E)", [-1.0 + 5.0 - 13.5, -3.0 - 3.0 - 22.5]);
    }
}

/// A rack pinned to a crank and held against a pinion on a fixed shaft, stated by places: crank angle 60°.
fn rack_on_crank(driver: u32, dimensions: bool) -> String {
    let (crank, radius, shaft) = (0.1, 0.04, 0.25);
    let pin = [crank * libm::cos(PI / 3.0), crank * libm::sin(PI / 3.0)];
    let way = [shaft - pin[0], -pin[1]];
    let direction = libm::atan2(way[1], way[0]) + libm::asin(radius / libm::hypot(way[0], way[1]));
    let end = [pin[0] + 0.3 * libm::cos(direction), pin[1] + 0.3 * libm::sin(direction)];
    let (known, sizes, angle) = if dimensions {
        let [x, y] = end;
        (
            format!(r#""near": {{ "E": [{x}, {y}] }}"#),
            [r#", "length": 0.1"#, r#", "length": 0.3"#],
            r#""angle": 60, "#,
        )
    } else {
        let ([a, b], [x, y]) = (pin, end);
        (format!(r#""placed": {{ "A": [{a}, {b}], "E": [{x}, {y}] }}"#), ["", ""], "")
    };
    let [crank, rack] = sizes;
    format!(
        r#"{{
          "fixed": {{ "O": [0, 0], "G": [0.25, 0] }}, {known},
          "links": {{
            "2": {{ "joins": ["O", "A"]{crank} }},
            "3": {{ "joins": ["A", "E"]{rack} }},
            "4": {{ "joins": ["G"] }}
          }},
          "rolls": [
            {{ "links": [3, 4], "line": {{ "link": 3, "through": "A", "toward": "E" }}, "centre": "G", "radius": 0.04 }}
          ],
          "input": {{ "link": {driver}, {angle}"omega": 5, "alpha": 2 }},
          "find": ["v(A)", "v(E)", "a(E)", "omega(2)", "omega(3)", "omega(4)", "alpha(2)", "alpha(3)", "alpha(4)"]
        }}"#
    )
}

/// Direction of the rack and turn of the pinion by the crank's angle: the rack's line is tangent to the pinion, and
/// what of it has passed the contact has turned the pinion.
fn rack_and_pinion(crank: f64) -> [f64; 2] {
    let way = [0.25 - 0.1 * libm::cos(crank), -0.1 * libm::sin(crank)];
    let reach = libm::hypot(way[0], way[1]);
    let direction = libm::atan2(way[1], way[0]) + libm::asin(0.04 / reach);
    let past = libm::sqrt(reach * reach - 0.04 * 0.04);
    // The contact lies to the left of the way from the centre; the material past it goes with the pinion's rim.
    [direction, direction + past / 0.04]
}

#[test]
fn a_rack_on_a_crank_turns_a_pinion_whichever_is_driven() {
    let motion = |part: usize| rates(|t| rack_and_pinion(PI / 3.0 + 5.0 * t + t * t)[part]);
    let (rack, pinion) = (motion(0), motion(1));
    for dimensions in [false, true] {
        let by_crank = confirmed(&rack_on_crank(2, dimensions));
        near_to(by_crank.scalar("omega(3)").0, rack.0);
        near_to(by_crank.scalar("alpha(3)").0, rack.1);
        near_to(by_crank.scalar("omega(4)").0, pinion.0);
        near_to(by_crank.scalar("alpha(4)").0, pinion.1);
    }
    // The other way about: the ratio of the rates is the same, and the first derivative gives ω.
    for driver in [3, 4] {
        let drawn = confirmed(&rack_on_crank(driver, false));
        let ratio = 5.0 / pinion.0;
        near_to(drawn.scalar("omega(2)").0 / drawn.scalar("omega(4)").0, ratio);
        near_to(drawn.scalar("omega(3)").0 / drawn.scalar("omega(4)").0, rack.0 / pinion.0);
    }
}

/// Willis: with a ring at rest ω_arm = ω_sun r_sun / (r_sun + r_ring); the planet turns at −ω_arm (r_ring − r_planet)
/// / r_planet.
#[test]
fn an_epicyclic_train_driven_at_its_sun() {
    let drawn = confirmed(
        r#"{
          "units": { "length": "mm" },
          "fixed": { "O": [0, 0] },
          "placed": { "C": [60, 0] },
          "links": { "2": { "joins": ["O"] }, "3": { "joins": ["C"] }, "4": { "joins": ["O", "C"] } },
          "rolls": [
            { "links": [2, 3], "centres": ["O", "C"], "radii": [40, 20] },
            { "links": [1, 3], "centres": ["O", "C"], "radii": [80, 20], "internal": true }
          ],
          "input": { "link": 2, "omega": 10, "alpha": 4 },
          "find": ["omega(3)", "omega(4)", "alpha(3)", "alpha(4)", "v(C)", "a(C)"]
        }"#,
    );
    assert!(nothing_tried(&drawn));
    near_enough(drawn.scalar("omega(4)").0, 10.0 / 3.0);
    near_enough(drawn.scalar("alpha(4)").0, 4.0 / 3.0);
    near_enough(drawn.scalar("omega(3)").0, -10.0);
    near_enough(drawn.scalar("alpha(3)").0, -4.0);
    vector(&drawn, "v(C)", [0.0, 0.2]);
    vector(&drawn, "a(C)", [-0.06 * 100.0 / 9.0, 0.08]);
}

/// A bar driven by its angle, one end on a line of the frame, the other on a link that rides another line:
/// x_A + 2 cos θ = s cos φ and 2 sin θ = s sin φ.
#[test]
fn a_driven_bar_with_an_end_on_a_riding_link() {
    let text = |rider: &str, ride: &str| {
        format!(
            r#"{{
              "fixed": {{ "O": [0, 0] }},
              "links": {{ "3": {{ "joins": ["A", "B"], "length": 2 }}, "4": {{ {rider} }} }},
              "slides": [
                {{ "pin": "A", "on": {{ "link": 1, "through": "O", "angle": 0 }} }},
                {{ {ride} }}
              ],
              "near": {{ "A": [1.3, 0], "B": [0.3, 1.73] }},
              "input": {{ "link": 3, "angle": 120, "omega": 2, "alpha": 1 }},
              "find": ["x(A)", "v(A)", "a(A)", "v(B)", "a(B)"]
            }}"#
        )
    };
    let riding = text(r#""joins": ["B"]"#, r#""link": 4, "on": { "link": 1, "through": "O", "angle": 80 }"#);
    let beside = text(
        r#""joins": ["D", "B"], "length": 0.5"#,
        r#""link": 4, "on": { "link": 1, "through": "O", "angle": 80 }"#,
    );
    let x = |t: f64| {
        let bar = 2.0 * PI / 3.0 + 2.0 * t + 0.5 * t * t;
        2.0 * libm::sin(bar) / libm::tan(80.0 * PI / 180.0) - 2.0 * libm::cos(bar)
    };
    let (speed, acceleration) = rates(x);
    for text in [riding, beside] {
        let drawn = confirmed(&text);
        vector(&drawn, "x(A)", [x(0.0), 0.0]);
        near_to(drawn.vector("v(A)").0[0], speed);
        near_to(drawn.vector("a(A)").0[0], acceleration);
    }
}

/// ω of a four-bar's cranks from that of its driven coupler: V_B = V_A + V_BA across each crank in turn (what a crank's own
/// end has along the crank is none). The sheet draws that triangle, and tries nothing at any order.
#[test]
fn a_driven_coupler_needs_one_triangle() {
    use linkgram::graphical::construction::Act;
    let four_bar = |near: &str| {
        format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": [110, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A", "C"], "line": [0, 40, 55] }}, "3": {{ "joins": ["A", "B", "D"], "line": [0, 120, 50] }},
                        "4": {{ "joins": ["O4", "B"], "length": 80 }} }},
            "near": {{ {near} }}, "input": {{ "link": 3, "angle": 24, "omega": 3, "alpha": 2 }},
            "find": ["omega(2)", "omega(4)", "alpha(2)", "alpha(4)", "x(A)", "x(B)", "v(C)", "a(C)", "v(D)", "a(D)", "an(B/A)", "at(A/B)"] }}"#
        )
    };
    // A hint for one pin, for both, for a further point of the coupler or of a crank.
    for near in [
        r#""A": [20, 35]"#,
        r#""B": [125, 80]"#,
        r#""A": [20, 35], "B": [125, 80]"#,
        r#""D": [77, 55]"#,
        r#""C": [35, 43]"#,
    ] {
        let drawn = confirmed(&four_bar(near));
        let ([ax, ay], [bx, by]) = (drawn.vector("x(A)").0, drawn.vector("x(B)").0);
        let (second, third, fourth) =
            (libm::atan2(ay, ax), libm::atan2(by - ay, bx - ax), libm::atan2(by, bx - 110.0));
        near_enough(third, 24.0 * PI / 180.0);
        let omega = |of: f64, length: f64, other: f64, sense: f64| {
            sense * 3.0 * 120.0 * libm::sin(third - other) / (length * libm::sin(of - other))
        };
        near_enough(drawn.scalar("omega(2)").0, omega(second, 40.0, fourth, -1.0));
        near_enough(drawn.scalar("omega(4)").0, omega(fourth, 80.0, second, 1.0));
        let acts = drawn.solution.construction.steps.iter().flat_map(|step| &step.acts);
        let tried = acts.filter(|act| {
            matches!(act, Act::TryPosition { .. } | Act::TryPolygon { .. } | Act::TrialRate { .. })
        });
        assert_eq!(tried.count(), 0, "{near}");
    }
}

/// The rod of a slider-crank is driven; under load with friction both solvers find the same forces.
#[test]
fn a_driven_rod_carries_loads() {
    for rubs in [
        "",
        r#", "pins": { "O2": { "radius": 5, "f": 0.1 }, "A": { "radius": 5, "f": 0.1 }, "B": { "radius": 5, "f": 0.1 } }"#,
    ] {
        let drawn = confirmed(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 40 }}, "3": {{ "joins": ["A", "B"], "length": 120 }} }},
            "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }} ], "near": {{ "B": [130, 0] }},
            "input": {{ "link": 3, "angle": -15, "omega": 3, "alpha": 5 }}, "gravity": {{}},
            "masses": {{ "2": {{ "mass": 1, "at": [20, 0], "inertia": 0.001 }}, "3": {{ "mass": 2, "at": [60, 0], "inertia": 0.01 }}, "4": {{ "mass": 1.5 }} }},
            "loads": [ {{ "on": 4, "at": "B", "force": [-100, 0] }}, {{ "on": 2, "torque": "0.5 N*m" }} ]{rubs},
            "find": ["T(3)", "F(2,3)", "F(3,4)", "F(1,2)", "F(1,4)", "v(B)", "omega(2)", "alpha(2)"] }}"#
        ));
        // B stays at its height: 40 sin θ₂ = 120 sin 15°, and so do its derivatives.
        let rod = PI / 12.0;
        let crank = libm::asin(120.0 * libm::sin(rod) / 40.0);
        near_enough(drawn.scalar("omega(2)").0, -3.0 * 120.0 * libm::cos(rod) / (40.0 * libm::cos(crank)));
    }
}

/// The sheet tries nothing, at any order.
fn nothing_tried(drawn: &Drawn) -> bool {
    use linkgram::graphical::construction::Act;
    let mut acts = drawn.solution.construction.steps.iter().flat_map(|step| &step.acts);
    !acts.any(|act| matches!(act, Act::TryPosition { .. } | Act::TryPolygon { .. } | Act::TrialRate { .. }))
}

/// Height of a triangle over its first side and how far its foot lies along it, by the lengths of the other two.
fn apex(first: f64, [second, third]: [f64; 2]) -> [f64; 2] {
    let along = (first * first + second * second - third * third) / (2.0 * first);
    [along, libm::sqrt(second * second - along * along)]
}

/// A boom O₂B of 1.8 on a cylinder from O₄ (1.2, −0.5), which is driven: the sides of the triangle tell all angles, their rates are
/// differences, and the power of the effort is that of the load. However the cylinder is stated: the boom's pin in its slot or
/// with a block, a rod with the pin, the rod on the frame and the cylinder with the pin, a slot beside O₄, all by places.
#[test]
fn a_driven_cylinder_needs_one_triangle() {
    let [side, lies] = [1.3, libm::atan2(-0.5, 1.2)];
    let length = |t: f64| 1.9 + 0.08 * t - 0.005 * t * t;
    let offset = 0.25;
    let boom = |reach: f64| {
        let [along, high] = apex(side, [1.8, reach]);
        lies + libm::atan2(high, along)
    };
    let cylinder = |reach: f64| {
        let angle = boom(reach);
        libm::atan2(1.8 * libm::sin(angle) + 0.5, 1.8 * libm::cos(angle) - 1.2)
    };
    let plain = |t: f64| (boom(length(t)), cylinder(length(t)));
    let beside = |t: f64| {
        let reach = libm::hypot(length(t), offset);
        (boom(reach), cylinder(reach) - libm::atan2(offset, length(t)))
    };
    let at_b = |angle: f64| format!("[{}, {}]", 1.8 * libm::cos(angle), 1.8 * libm::sin(angle));
    let near = r#""near": { "B": [1.2, 1.3] }"#;
    let placed = format!(r#""placed": {{ "B": {} }}"#, at_b(plain(0.0).0));
    let slot = r#""3": { "joins": ["O4"] }"#;
    let own = r#""3": { "joins": ["O4", "K"], "length": 0.4 }"#;
    let through = r#"{ "link": 3, "through": "O4", "angle": 0 }"#;
    let aside = r#"{ "link": 3, "through": "O4", "toward": "K", "offset": 0.25 }"#;
    let at = r#""at": 1.9, "#;
    let cases: [(&str, String, &str, &str, &str, bool); 7] = [
        (slot, format!(r#"{{ "pin": "B", "on": {through} }}"#), r#""B""#, at, near, false),
        (slot, format!(r#"{{ "pin": "B", "block": 5, "on": {through} }}"#), "5", at, near, false),
        (slot, format!(r#"{{ "pin": "B", "on": {through} }}"#), r#""B""#, "", &placed, false),
        (
            r#""3": { "joins": ["O4"] }, "4": { "joins": ["B"] }"#,
            format!(r#"{{ "link": 4, "on": {through} }}"#),
            "4",
            at,
            near,
            false,
        ),
        (
            r#""3": { "joins": ["O4"] }, "4": { "joins": ["B"] }"#,
            r#"{ "link": 3, "on": { "link": 4, "through": "B", "angle": 0 } }"#.to_owned(),
            "3",
            at,
            near,
            false,
        ),
        (own, format!(r#"{{ "pin": "B", "on": {aside} }}"#), r#""B""#, at, near, true),
        (own, format!(r#"{{ "pin": "B", "block": 5, "on": {aside} }}"#), "5", at, near, true),
    ];
    for (links, slide, driven, at, places, is_beside) in cases {
        let text = format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": [1.2, -0.5] }},
            "links": {{ "2": {{ "joins": ["O2", "B", "P"], "line": [0, 1.8, 4.5] }}, {links} }},
            "slides": [ {slide} ], {places},
            "input": {{ "slide": {driven}, {at}"velocity": 0.08, "acceleration": -0.01 }},
            "loads": [ {{ "name": "W", "on": 2, "at": "P", "force": [0, -12000] }} ],
            "find": ["omega(2)", "alpha(2)", "omega(3)", "alpha(3)", "v(P)", "a(P)", "x(B)", "drive({})", "F(1,2)", "F(1,3)"] }}"#,
            driven.trim_matches('"')
        );
        let drawn = confirmed(&text);
        assert!(nothing_tried(&drawn), "{text}");
        let motion = |t: f64| if is_beside { beside(t) } else { plain(t) };
        let close = |found: f64, expected: f64| {
            assert!((found - expected).abs() < 1e-8, "{found} {expected}\n{text}")
        };
        let (omega, alpha) = rates(|t| motion(t).0);
        close(drawn.scalar("omega(2)").0, omega);
        close(drawn.scalar("alpha(2)").0, alpha);
        let (omega, alpha) = rates(|t| motion(t).1);
        close(drawn.scalar("omega(3)").0, omega);
        close(drawn.scalar("alpha(3)").0, alpha);
        let power = drawn.vector("v(P)").0[1] * -12000.0;
        let effort = drawn.scalar(&format!("drive({})", driven.trim_matches('"'))).0;
        assert!((effort * 0.08 + power).abs() < 1e-8 * power.abs(), "{effort} {power}\n{text}");
    }
}

/// A cylinder that pushes a slider along a line of the frame, and a pin on two cylinders: by the lengths of the triangle.
#[test]
fn a_driven_cylinder_moves_a_slider_and_two_of_them_a_pin() {
    let drawn = confirmed(
        r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O"] } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 2, "through": "O" } },
                    { "pin": "B", "block": 3, "on": { "link": 1, "through": [0, 3], "angle": 0 } } ],
        "near": { "B": [4, 3] }, "input": { "slide": 4, "at": 5, "velocity": 2, "acceleration": 1 },
        "loads": [ { "on": 3, "at": "B", "force": [-20, 0] } ],
        "find": ["v(B)", "a(B)", "omega(2)", "alpha(2)", "x(B)", "F(1,2)"] }"#,
    );
    let along = |t: f64| {
        let length = 5.0 + 2.0 * t + 0.5 * t * t;
        libm::sqrt(length * length - 9.0)
    };
    let (speed, acceleration) = rates(along);
    assert!(nothing_tried(&drawn));
    vector(&drawn, "x(B)", [4.0, 3.0]);
    for (name, expected) in [("v(B)", speed), ("a(B)", acceleration)] {
        let found = drawn.vector(name).0;
        assert!((found[0] - expected).abs() < 1e-8 && found[1].abs() < 1e-9, "{name} {found:?}");
    }
    // The slider needs 20 along its guide, of a force along the cylinder.
    vector(&drawn, "F(1,2)", [20.0, 15.0]);
}

/// Sun and ring both driven: r_S ω_S + r_R ω_R = (r_S + r_R) ω_arm. A load on the arm: the power of both efforts is its own.
#[test]
fn an_epicyclic_train_driven_at_sun_and_ring() {
    let drawn = confirmed(
        r#"{ "fixed": { "O": [0, 0] }, "placed": { "C": [48, 36], "E": [30, 40], "K": [10, 50] },
          "links": { "2": { "joins": ["O"] }, "3": { "joins": ["C", "E"] }, "4": { "joins": ["O", "C", "K"] }, "5": { "joins": ["O"] } },
          "rolls": [
            { "links": [2, 3], "centres": ["O", "C"], "radii": [40, 20] },
            { "links": [5, 3], "centres": ["O", "C"], "radii": [80, 20], "internal": true }
          ],
          "inputs": [ { "link": 2, "omega": 10, "alpha": 4 }, { "link": 5, "omega": -3, "alpha": 1 } ],
          "loads": [ { "on": 4, "torque": -60 } ],
          "find": ["omega(3)", "omega(4)", "alpha(3)", "alpha(4)", "v(E)", "a(E)", "v(K)", "a(K)", "T(2)", "T(5)", "F(3,4)"] }"#,
    );
    assert!(nothing_tried(&drawn));
    let arm = |sun: f64, ring: f64| (40.0 * sun + 80.0 * ring) / 120.0;
    near_enough(drawn.scalar("omega(4)").0, arm(10.0, -3.0));
    near_enough(drawn.scalar("alpha(4)").0, arm(4.0, 1.0));
    let planet = |sun: f64, ring: f64| (80.0 * ring - 40.0 * sun) / 40.0;
    near_enough(drawn.scalar("omega(3)").0, planet(10.0, -3.0));
    near_enough(drawn.scalar("alpha(3)").0, planet(4.0, 1.0));
    near_enough(drawn.scalar("T(2)").0, 20.0);
    near_enough(drawn.scalar("T(5)").0, 40.0);
}

/// A driven rack whose pin is the contact itself: V_A = 0, for the wheel's rim and the crank's pin go different ways there, and
/// with ω₃ = 2 the wheel's rim has what A has along the rack: A_A = (−36, 120) of ε₂ = 1.2, so that ε₄ = 36 / 30.
#[test]
fn a_driven_rack_whose_pin_is_the_contact() {
    let drawn = confirmed(
        r#"{ "fixed": { "O2": [0, 0], "O4": [100, 0] },
          "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "E"] }, "4": { "joins": ["O4", "W"] } },
          "rolls": [ { "links": [3, 4], "line": { "link": 3, "through": "A", "toward": "E" }, "centre": "O4", "radius": 30 } ],
          "placed": { "A": [100, 30], "E": [180, 30], "W": [100, 20] },
          "input": { "link": 3, "omega": 2 },
          "find": ["omega(2)", "omega(4)", "alpha(2)", "alpha(4)", "v(A)", "v(E)", "a(A)", "v(W)", "a(W)"] }"#,
    );
    for (name, expected) in [("omega(2)", 0.0), ("omega(4)", 0.0), ("alpha(2)", 1.2), ("alpha(4)", 1.2)] {
        near_enough(drawn.scalar(name).0, expected);
    }
    vector(&drawn, "a(A)", [-36.0, 120.0]);
    vector(&drawn, "a(W)", [-24.0, 0.0]);
}

/// A cylinder on a driven crank moves a rocker, which carries a load: every number of the sheet is confirmed, and the power of both
/// efforts is that of the load. Its rod has the pin, or it has the pin itself and its rod is on the crank.
#[test]
fn a_driven_cylinder_on_a_crank() {
    for (link, slide, at) in [
        (
            r#"["H", "B"]"#,
            r#"{ "link": 5, "on": { "link": 3, "through": "C", "toward": "K" } }"#,
            r#""slide": 5, "at": 2.1"#,
        ),
        (
            r#"["B", "H"]"#,
            r#"{ "link": 3, "turned": 180, "on": { "link": 5, "through": "B", "toward": "H", "offset": 0.2 } }"#,
            r#""slide": 3, "at": 3"#,
        ),
    ] {
        let text = format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": [4, 0.5] }},
            "links": {{ "2": {{ "joins": ["O2", "C"], "length": 1 }}, "3": {{ "joins": ["C", "K"], "length": 0.7 }},
                        "4": {{ "joins": ["O4", "B", "E"], "line": [0, 2, 2.5] }}, "5": {{ "joins": {link}, "length": 0.9 }} }},
            "slides": [ {slide} ], "near": {{ "B": [3.4, 2.4], "H": [2.5, 2.0], "K": [1.2, 1.2] }},
            "inputs": [ {{ "link": 2, "angle": 60, "omega": 2, "alpha": 1 }}, {{ {at}, "velocity": 0.5, "acceleration": -0.3 }} ],
            "loads": [ {{ "on": 4, "at": "E", "force": [30, -50] }} ],
            "find": ["T(2)", "drive({})", "v(E)", "a(E)", "omega(3)", "alpha(3)", "omega(4)", "alpha(4)", "a(K)", "a(H)", "F(2,3)", "F(3,5)"] }}"#,
            if slide.starts_with(r#"{ "link": 5"#) { 5 } else { 3 }
        );
        let drawn = confirmed(&text);
        assert!(nothing_tried(&drawn), "{text}");
        let scene = common::read(&text);
        let solved = solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        linkgram::check::confirm(&scene, &solved).unwrap();
        let ([vx, vy], _) = drawn.vector("v(E)");
        let drive = if text.contains("drive(5)") { "drive(5)" } else { "drive(3)" };
        let given = drawn.scalar("T(2)").0 * 2.0 + drawn.scalar(drive).0 * 0.5;
        assert!((given + 30.0 * vx - 50.0 * vy).abs() < 1e-9 * 100.0, "{given}\n{text}");
    }
}

/// A bar slides on a lever without turning; it is led by a crank at its second joint, so that the lever is not solved by the
/// point of it under the first. The parts of that point's acceleration are −ω² r and α × r about the lever's pivot.
#[test]
fn parts_of_the_acceleration_under_a_rider_that_leads_nothing() {
    for (offset, turned) in [(5.0, 20.0), (0.0, 20.0), (-8.0, 35.0)] {
        let drawn = confirmed(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O3": [60, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "K"], "length": 80 }}, "5": {{ "joins": ["D", "P"], "length": 30 }},
                        "3": {{ "joins": ["O3", "P"], "length": 25 }} }},
            "slides": [ {{ "link": 5, "turned": {turned},
                           "on": {{ "link": 2, "through": "O2", "toward": "K", "offset": {offset} }} }} ],
            "near": {{ "D": [40, 10], "P": [70, 24], "K": [75, 20] }},
            "input": {{ "link": 3, "angle": 70, "omega": 2, "alpha": 1 }},
            "find": ["an(D@2)", "at(D@2)", "x(D)", "omega(2)", "alpha(2)"] }}"#
        ));
        let (at, _) = drawn.vector("x(D)");
        let ((omega, _), (alpha, _)) = (drawn.scalar("omega(2)"), drawn.scalar("alpha(2)"));
        vector(&drawn, "an(D@2)", at.map(|c| -omega * omega * c));
        vector(&drawn, "at(D@2)", [-alpha * at[1], alpha * at[0]]);
    }
}
