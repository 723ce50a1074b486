//! What was laid off elsewhere than given costs one mark and is named: a guide, the third point of a link, an image by
//! proportion, a scale, a closing line, the sign of a moment. The numbers are those of whoever made that one mistake, by
//! loop equations in closed form that share nothing with the program.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use linkgram::exam::Loose;
use linkgram::grade::{Kind, Report, Verdict};
use serde_json::{Value, json};

use crate::common::hand_in::{graded, terms};
use crate::common::plane::{self, Xy, cross, dot, long, minus, plus, times, turned};

/// At this angle, degrees.
fn unit(degrees: f64) -> Xy {
    plane::unit(degrees.to_radians())
}

/// Turned counter-clockwise.
fn rotated(a: Xy, degrees: f64) -> Xy {
    let [c, s] = unit(degrees);
    [c * a[0] - s * a[1], s * a[0] + c * a[1]]
}

fn vector(value: Xy) -> Value {
    json!({ "components": value })
}

fn rate(value: f64) -> Value {
    json!({ "value": value.abs(), "sense": if value < 0.0 { "cw" } else { "ccw" } })
}

fn report(scene: &Value, answers: &Value) -> Report {
    graded(&linkgram::scene::read(&scene.to_string(), "scene.json").unwrap(), answers)
}

fn wrong(report: &Report) -> Vec<&str> {
    let wrong = report.quantities.iter().filter(|one| one.verdict == Verdict::Wrong);
    wrong.map(|one| one.name.as_str()).collect()
}

fn first_kind(report: &Report) -> Option<Kind> {
    report.first_fault().and_then(|fault| fault.mistakes.first()).map(|mistake| mistake.kind)
}

/// One answer is wrong, all others are right or follow, and the mistake has this name.
fn costs_one(scene: &Value, values: &Value, kind: Option<Kind>) -> Report {
    let report = report(scene, &json!({ "values": values }));
    assert_eq!(wrong(&report).len(), 1, "{}", report.to_text());
    if kind.is_some() {
        assert_eq!(first_kind(&report), kind, "{}", report.to_text());
    }
    report
}

// --- guides ------------------------------------------------------------------------------------

const SPEED: f64 = -8.0 * std::f64::consts::PI;

fn slider(through: Xy, angle: f64) -> Value {
    json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 5.5 }, "3": { "joins": ["A", "B", "G"], "line": [0, 19, 7] }
        },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": through, "angle": angle } }],
        "near": { "B": [14, -3] }, "input": { "link": 2, "angle": 130, "omega": "240 rpm cw" },
        "find": ["v(B)", "v(G)", "omega(3)", "a(B)", "a(G)", "alpha(3)"]
    })
}

/// A and B of that slider on a guide through a point, and what it answers.
fn slides_on(through: Xy, angle: f64) -> ([Xy; 2], Value) {
    let (a, u) = (times(unit(130.0), 5.5), unit(angle));
    let from = minus(through, a);
    let half = dot(from, u);
    let far = -half + (half * half - dot(from, from) + 19.0 * 19.0).sqrt();
    let b = plus(through, times(u, far));
    let ba = minus(b, a);
    let (va, aa) = (turned(SPEED, a), times(a, -SPEED * SPEED));
    let vb = times(u, dot(ba, va) / dot(ba, u));
    let vba = minus(vb, va);
    let ab = times(u, (dot(ba, aa) - dot(vba, vba)) / dot(ba, u));
    let aba = minus(ab, aa);
    let (omega, alpha) = (cross(ba, vba) / 361.0, cross(ba, aba) / 361.0);
    let part = 7.0 / 19.0;
    let values = json!({
        "v(B)": vector(vb), "v(G)": vector(plus(va, times(vba, part))), "omega(3)": rate(omega),
        "a(B)": vector(ab), "a(G)": vector(plus(aa, times(aba, part))), "alpha(3)": rate(alpha)
    });
    ([a, b], values)
}

#[test]
fn a_guide_that_is_laid_off_elsewhere_costs_one_mark() {
    let scene = slider([0.0, -3.0], 0.0);
    let right = report(&scene, &json!({ "values": slides_on([0.0, -3.0], 0.0).1 }));
    assert!(right.first_fault().is_none(), "{}", right.to_text());
    for (offset, told) in
        [(3.0, "on the other side of O2"), (0.0, "through O2"), (-6.0, "6 for 3 cm"), (-5.0, "about 2.0")]
    {
        let report = costs_one(&scene, &slides_on([0.0, offset], 0.0).1, Some(Kind::GuideMisplaced));
        assert!(report.to_text().contains(told), "{}", report.to_text());
        assert!(report.to_text().contains("the guide of B stands elsewhere"), "{}", report.to_text());
    }
    // 21 for 12 degrees, and the other side of the horizontal.
    let inclined = slider([0.0, -3.0], 12.0);
    for angle in [21.0, -12.0] {
        costs_one(&inclined, &slides_on([0.0, -3.0], angle).1, Some(Kind::GuideMisplaced));
    }
}

#[test]
fn two_answers_tell_a_forgotten_offset() {
    let mut scene = slider([0.0, -3.0], 0.0);
    scene["find"] = json!(["v(B)", "omega(3)"]);
    for offset in [0.0, 3.0] {
        let all = slides_on([0.0, offset], 0.0).1;
        let values = json!({ "v(B)": all["v(B)"], "omega(3)": all["omega(3)"] });
        costs_one(&scene, &values, Some(Kind::GuideMisplaced));
    }
}

#[test]
fn a_guide_is_seen_on_the_skeleton_that_is_handed_in() {
    let scene = slider([0.0, -3.0], 0.0);
    for offset in [3.0, -4.3] {
        let ([a, b], values) = slides_on([0.0, offset], 0.0);
        let mm = |at: Xy| times(at, 10.0);
        let skeleton = json!({ "O2": [0, 0], "A": mm(a), "B": mm(b) });
        let answers = json!({
            "values": values, "points": { "skeleton": skeleton }, "scales": { "length": "1:1" }
        });
        let report = report(&scene, &answers);
        assert_eq!(wrong(&report), ["skeleton:B"], "{}", report.to_text());
        assert_eq!(first_kind(&report), Some(Kind::GuideMisplaced), "{}", report.to_text());
    }
}

// --- the third point of a link -------------------------------------------------------------------

const RATE: [f64; 2] = [3.0 * std::f64::consts::PI, -12.0];
const PIVOT: Xy = [210.0, -20.0];

fn coupler(find: &[&str]) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": PIVOT },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 70 }, "3": { "joins": ["A", "B", "C"], "arms": [190, 110, 35] },
            "4": { "joins": ["O4", "B"], "length": 130 }
        },
        "near": { "B": [190, 110] },
        "input": { "link": 2, "angle": 75, "omega": "90 rpm ccw", "alpha": "12 rad/s^2 cw" }, "find": find
    })
}

/// A, B, and ω and ε of coupler and rocker.
struct FourBar {
    a: Xy,
    b: Xy,
    va: Xy,
    aa: Xy,
    omega: Xy,
    alpha: Xy,
}

fn four_bar(pivot: Xy) -> FourBar {
    let a = times(unit(75.0), 70.0);
    let across = minus(pivot, a);
    let d = long(across);
    let along = (190.0 * 190.0 - 130.0 * 130.0 + d * d) / (2.0 * d);
    let beside = (190.0 * 190.0 - along * along).sqrt();
    let u = times(across, 1.0 / d);
    let b = plus(a, plus(times(u, along), times([-u[1], u[0]], beside)));
    let (ba, bo) = (minus(b, a), minus(b, pivot));
    // ω₃ × BA − ω₄ × BO₄ = d
    let solved = |d: Xy| {
        let (one, two) = (turned(1.0, ba), turned(-1.0, bo));
        let whole = cross(one, two);
        [cross(d, two) / whole, cross(one, d) / whole]
    };
    let va = turned(RATE[0], a);
    let omega = solved(times(va, -1.0));
    let aa = plus(turned(RATE[1], a), times(a, -RATE[0] * RATE[0]));
    let normal = minus(times(ba, omega[0] * omega[0]), times(bo, omega[1] * omega[1]));
    let alpha = solved(minus(normal, aa));
    FourBar { a, b, va, aa, omega, alpha }
}

impl FourBar {
    /// V and A of a point of the coupler that stands so from A.
    fn coupler_point(&self, arm: Xy) -> [Xy; 2] {
        let [w, e] = [self.omega[0], self.alpha[0]];
        [plus(self.va, turned(w, arm)), plus(self.aa, plus(turned(e, arm), times(arm, -w * w)))]
    }

    fn answers(&self, c: [Xy; 2]) -> Value {
        let b = self.coupler_point(minus(self.b, self.a));
        json!({
            "v(B)": vector(b[0]), "v(C)": vector(c[0]), "omega(3)": rate(self.omega[0]),
            "omega(4)": rate(self.omega[1]), "a(B)": vector(b[1]), "a(C)": vector(c[1]),
            "alpha(3)": rate(self.alpha[0]), "alpha(4)": rate(self.alpha[1])
        })
    }
}

const ALL_OF_COUPLER: [&str; 8] =
    ["v(B)", "v(C)", "omega(3)", "omega(4)", "a(B)", "a(C)", "alpha(3)", "alpha(4)"];

#[test]
fn a_third_point_that_is_laid_off_elsewhere_costs_one_mark() {
    let scene = coupler(&ALL_OF_COUPLER);
    let own = four_bar(PIVOT);
    let along = times(minus(own.b, own.a), 1.0 / 190.0);
    let at = |length: f64, angle: f64| own.coupler_point(rotated(times(along, length), angle));
    let right = report(&scene, &json!({ "values": own.answers(at(110.0, 35.0)) }));
    assert!(right.first_fault().is_none(), "{}", right.to_text());
    for (length, angle) in [(80.0, 35.0), (110.0, 53.0), (110.0, 55.0), (110.0, 145.0), (55.0, 35.0)] {
        costs_one(&scene, &own.answers(at(length, angle)), Some(Kind::PointLaidOff));
    }
    // The image on the line ab, as far from a as C is from A.
    costs_one(&scene, &own.answers(at(110.0, 0.0)), Some(Kind::ImageOnLine));
}

#[test]
fn a_point_beyond_two_others_is_divided_off_from_the_wrong_one() {
    // V_C by BC/O₄B in the place of O₄C/O₄B.
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": PIVOT },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 70 }, "3": { "joins": ["A", "B"], "length": 190 },
            "4": { "joins": ["O4", "B", "C"], "line": [0, 130, 200] }
        },
        "near": { "B": [190, 110] },
        "input": { "link": 2, "angle": 75, "omega": "90 rpm ccw", "alpha": "12 rad/s^2 cw" },
        "find": ["v(B)", "v(C)", "a(C)"]
    });
    let own = four_bar(PIVOT);
    let [v, a] = own.coupler_point(minus(own.b, own.a));
    let part = 70.0 / 130.0;
    let values = json!({ "v(B)": vector(v), "v(C)": vector(times(v, part)), "a(C)": vector(times(a, part)) });
    costs_one(&scene, &values, Some(Kind::ProportionFromOtherEnd));
}

#[test]
fn a_halved_coordinate_of_a_pivot_is_named() {
    let own = four_bar([210.0, -10.0]);
    let along = times(minus(own.b, own.a), 1.0 / 190.0);
    let c = own.coupler_point(rotated(times(along, 110.0), 35.0));
    costs_one(&coupler(&ALL_OF_COUPLER), &own.answers(c), Some(Kind::PivotMisplaced));
}

// --- a closing line ------------------------------------------------------------------------------

/// V_B and ω₃ of a polygon whose line ab is drawn so many degrees off.
fn closed_by(off: f64) -> (Xy, f64) {
    let own = four_bar(PIVOT);
    let (ba, bo) = (minus(own.b, own.a), minus(own.b, PIVOT));
    let (along, line) = (rotated(turned(1.0, ba), off), turned(1.0, bo));
    let b = times(line, cross(own.va, along) / cross(line, along));
    let vba = minus(b, own.va);
    (b, (long(vba) / long(ba)).copysign(cross(ba, vba)))
}

#[test]
fn one_wrong_closing_line_costs_one_mark() {
    let scene = coupler(&["v(B)", "omega(3)"]);
    for off in [20.0, 30.0, 40.0] {
        let (b, omega) = closed_by(off);
        let report = costs_one(&scene, &json!({ "v(B)": vector(b), "omega(3)": rate(omega) }), None);
        assert_eq!(wrong(&report), ["v(B)"], "{}", report.to_text());
        // What does not belong to that polygon does not follow.
        let other = json!({ "v(B)": vector(b), "omega(3)": rate(1.4 * omega) });
        let report = self::report(&scene, &json!({ "values": other }));
        assert_eq!(wrong(&report).len(), 2, "{}", report.to_text());
    }
}

// --- a scale -------------------------------------------------------------------------------------

/// A quick return, all velocities read `scale` times too large; V_B by the own ω₄. `stretch`: V of the point under the block
/// is so many times too long, and the velocity of sliding closes the triangle.
struct QuickReturn {
    under: Xy,
    slip: Xy,
    omega: f64,
    b: Xy,
    coriolis: Xy,
    alpha: f64,
    sliding: Xy,
    under_accelerates: Xy,
    b_accelerates: Xy,
}

fn quick_return(scale: f64, stretch: f64) -> QuickReturn {
    let rate = -2.0 * std::f64::consts::PI;
    let a = times(unit(25.0), 90.0);
    let arm = minus(a, [0.0, -160.0]);
    let u = times(arm, 1.0 / long(arm));
    let n = [-u[1], u[0]];
    let va = turned(rate, a);
    let drawn = times(n, stretch * dot(va, n));
    let (under, slip) = (times(drawn, scale), times(minus(va, drawn), scale));
    let omega = dot(under, n) / long(arm);
    let coriolis = turned(2.0 * omega, slip);
    let normal = times(arm, -omega * omega);
    // What is left of A_A along the guide and square to it.
    let rest = minus(minus(times(a, -rate * rate), normal), coriolis);
    let alpha = dot(rest, n) / long(arm);
    let under_accelerates = plus(normal, times(n, dot(rest, n)));
    QuickReturn {
        under,
        slip,
        omega,
        b: times(n, omega * 340.0),
        coriolis,
        alpha,
        sliding: times(u, dot(rest, u)),
        under_accelerates,
        b_accelerates: times(under_accelerates, 340.0 / long(arm)),
    }
}

impl QuickReturn {
    fn answers(&self, find: &[&str]) -> Value {
        let all = json!({
            "v(A@4)": vector(self.under), "slip(A/4)": vector(self.slip), "omega(4)": rate(self.omega),
            "v(B)": vector(self.b), "coriolis(A/4)": vector(self.coriolis), "alpha(4)": rate(self.alpha),
            "aslip(A/4)": vector(self.sliding), "a(A@4)": vector(self.under_accelerates),
            "a(B)": vector(self.b_accelerates)
        });
        find.iter().map(|name| ((*name).to_owned(), all[*name].clone())).collect()
    }

    fn scene(find: &[&str]) -> Value {
        json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, -160] },
            "links": { "2": { "joins": ["O2", "A"], "length": 90 }, "4": { "joins": ["O4", "B"], "length": 340 } },
            "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } }],
            "near": { "B": [130, 150] }, "input": { "link": 2, "angle": 25, "omega": "60 rpm cw" }, "find": find
        })
    }
}

const ALL_OF_RETURN: [&str; 9] =
    ["v(A@4)", "slip(A/4)", "omega(4)", "v(B)", "coriolis(A/4)", "aslip(A/4)", "a(A@4)", "alpha(4)", "a(B)"];

#[test]
fn velocities_at_a_wrong_scale_cost_one_mark_whatever_is_calculated_from_them() {
    let finds: [&[&str]; 3] = [
        &["v(A@4)", "v(B)", "alpha(4)"],
        &["v(A@4)", "slip(A/4)", "v(B)", "coriolis(A/4)", "alpha(4)"],
        &ALL_OF_RETURN,
    ];
    for find in finds {
        let right = quick_return(1.0, 1.0).answers(find);
        let right = report(&QuickReturn::scene(find), &json!({ "values": right }));
        assert!(right.first_fault().is_none(), "{}", right.to_text());
        for scale in [0.3, 0.5, 0.8, 1.25, 1.5, 1.8, 2.0, 2.5, 4.0, 6.0] {
            let values = quick_return(scale, 1.0).answers(find);
            let report = costs_one(&QuickReturn::scene(find), &values, None);
            assert_eq!(wrong(&report), ["v(A@4)"], "{scale}: {}", report.to_text());
            assert_eq!(first_kind(&report), Some(Kind::ScaleWrong), "{scale}: {}", report.to_text());
        }
    }
}

/// V of the point under the block from a triangle with the right angle at the wrong corner: a true point of that polygon
/// beside the same values takes nothing away.
#[test]
fn a_point_of_the_drawing_beside_the_same_values_costs_nothing() {
    let own = quick_return(1.0, 1.847);
    let scene = QuickReturn::scene(&ALL_OF_RETURN);
    let values = own.answers(&ALL_OF_RETURN);
    let marks = |answers: Value| {
        let report = report(&scene, &answers);
        (report.sum().0, report.to_text())
    };
    let (alone, text) = marks(json!({ "values": values }));
    assert!(alone >= 7.0, "{text}");
    let mm = times(own.under, 0.1);
    let answers = json!({
        "values": values, "points": { "velocity": { "o": [0, 0], "a4": mm } },
        "scales": { "velocity": "10 mm/s per mm" }
    });
    let (with, text) = marks(answers);
    assert!(with >= alone, "{with} of {alone}\n{text}");
}

// --- forces --------------------------------------------------------------------------------------

/// A slider-crank of 10 and 35 cm at 60° with 1200 N on the rough slider.
struct RoughSlider {
    rod: Xy,
    guide: Xy,
    torque: f64,
}

fn rough_slider(roughness: f64, longer: f64) -> RoughSlider {
    let a = times(unit(60.0), 10.0);
    let b = [a[0] + (35.0 * 35.0 - a[1] * a[1]).sqrt(), 0.0];
    let u = times(minus(b, a), 1.0 / 35.0);
    // It slides to the left: friction points to the right, u downward, so that the guide presses upward.
    let size = longer * 1200.0 / (u[0] - roughness * u[1]);
    let rod = times(u, size);
    RoughSlider { rod, guide: minus([1200.0, 0.0], rod), torque: size * cross(a, u) / 100.0 }
}

#[test]
fn a_rough_slider_follows_from_the_own_force_of_the_rod() {
    let scene = json!({
        "units": { "length": "cm", "torque": "N·m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 10 }, "3": { "joins": ["A", "B"], "length": 35 } },
        "slides": [
            { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 }, "f": 0.25 }
        ],
        "near": { "B": [40, 0] }, "input": { "link": 2, "angle": 60, "omega": "5 rad/s ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": "1200 N", "direction": 180 }],
        "find": ["F(3,4)", "F(1,4)", "F(1,2)", "T(2)"]
    });
    let answers = |own: &RoughSlider| {
        json!({
            "F(3,4)": vector(own.rod), "F(1,4)": vector(own.guide), "F(1,2)": vector(own.rod),
            "T(2)": format!("{:.4} N·m {}", own.torque.abs(), if own.torque < 0.0 { "cw" } else { "ccw" })
        })
    };
    let right = report(&scene, &json!({ "values": answers(&rough_slider(0.25, 1.0)) }));
    assert!(right.first_fault().is_none(), "{}", right.to_text());
    for longer in [0.7, 0.9, 1.2] {
        let report = costs_one(&scene, &answers(&rough_slider(0.25, longer)), None);
        assert_eq!(wrong(&report), ["F(3,4)"], "{}", report.to_text());
    }
    costs_one(&scene, &answers(&rough_slider(0.5, 1.0)), Some(Kind::FrictionMisread));
    // A guide's force that closes no polygon does not follow.
    let mut own = rough_slider(0.25, 0.9);
    own.guide = times(own.guide, 1.3);
    let report = report(&scene, &json!({ "values": answers(&own) }));
    assert_eq!(wrong(&report), ["F(3,4)", "F(1,4)"], "{}", report.to_text());
}

#[test]
fn a_moment_with_the_wrong_sign_is_named() {
    let scene = json!({
        "units": { "length": "cm", "torque": "N*m" }, "fixed": { "O2": [0, 0], "O4": [30, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 12 }, "3": { "joins": ["A", "B"], "length": 32 },
            "4": { "joins": ["O4", "B", "Q"], "line": [0, 20, 13] }
        },
        "near": { "B": [32, 20] }, "input": { "link": 2, "angle": 70 },
        "loads": [{ "name": "P", "on": 4, "at": "Q", "force": "500 N", "direction": 20 }],
        "find": ["F(3,4)", "F(1,4)", "F(2,3)", "T(2)"]
    });
    let a = times(unit(70.0), 12.0);
    let o4 = [30.0, 0.0];
    let across = minus(o4, a);
    let d = long(across);
    let along = (32.0 * 32.0 - 400.0 + d * d) / (2.0 * d);
    let u = times(across, 1.0 / d);
    let b = plus(a, plus(times(u, along), times([-u[1], u[0]], (32.0 * 32.0 - along * along).sqrt())));
    let (rod, q) = (times(minus(b, a), 1.0 / 32.0), plus(o4, times(minus(b, o4), 13.0 / 20.0)));
    let load = times(unit(20.0), 500.0);
    let with_sign = |sign: f64| {
        let size = -sign * cross(minus(q, o4), load) / cross(minus(b, o4), rod);
        let force = times(rod, size);
        json!({
            "F(3,4)": vector(force), "F(1,4)": vector(times(plus(load, force), -1.0)), "F(2,3)": vector(force),
            "T(2)": rate(cross(a, force) / 100.0)
        })
    };
    let right = report(&scene, &json!({ "values": with_sign(1.0) }));
    assert!(right.first_fault().is_none(), "{}", right.to_text());
    costs_one(&scene, &with_sign(-1.0), Some(Kind::MomentReversed));
}

// --- centres -------------------------------------------------------------------------------------

#[test]
fn distances_from_a_centre_that_are_mixed_up_are_named() {
    let pivot = [120.0, 10.0];
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": pivot },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 110 },
            "4": { "joins": ["O4", "B"], "length": 80 }
        },
        "near": { "B": [130, 90] }, "input": { "link": 2, "angle": 65, "omega": "10 rad/s cw" },
        "find": [
            "I(1,3)", { "name": "v(B)", "method": "centres" }, { "name": "omega(3)", "method": "centres" },
            { "name": "omega(4)", "method": "centres" }
        ]
    });
    let a = times(unit(65.0), 50.0);
    let across = minus(pivot, a);
    let d = long(across);
    let along = (110.0 * 110.0 - 6400.0 + d * d) / (2.0 * d);
    let u = times(across, 1.0 / d);
    let b = plus(a, plus(times(u, along), times([-u[1], u[0]], (110.0 * 110.0 - along * along).sqrt())));
    let bo = minus(b, pivot);
    // O₂A and O₄B meet.
    let centre = times(a, cross(pivot, bo) / cross(a, bo));
    let [to_a, to_b] = [minus(a, centre), minus(b, centre)];
    let va = turned(-10.0, a);
    let right = cross(to_a, va) / dot(to_a, to_a);
    let answers = |omega: f64, vb: f64| {
        let v = times(turned(right.signum(), to_b), vb / long(to_b));
        json!({
            "I(1,3)": vector(centre), "v(B)": vector(v), "omega(3)": rate(omega),
            "omega(4)": rate(cross(bo, v) / dot(bo, bo))
        })
    };
    let all_right = report(&scene, &json!({ "values": answers(right, right.abs() * long(to_b)) }));
    assert!(all_right.first_fault().is_none(), "{}", all_right.to_text());
    // ω₃ by the distance of the centre from O₂.
    let other = right * long(to_a) / long(centre);
    costs_one(&scene, &answers(other, other.abs() * long(to_b)), Some(Kind::WrongFormula));
    // V_B by the ratio of the distances upside down.
    costs_one(&scene, &answers(right, 500.0 * long(to_a) / long(to_b)), Some(Kind::RatioInverted));
}

/// No variant of an exam has a centre on two lines that are nearly one, nor one off the sheet.
#[test]
fn lines_of_centres_of_an_exam_cross_clearly() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [120, 10] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 110 },
            "4": { "joins": ["O4", "B"], "length": 80 }
        },
        "near": { "B": [130, 90] }, "input": { "link": 2, "angle": 65, "omega": "10 rad/s cw" },
        "find": ["I(1,3)", "I(2,4)"],
        "vary": {
            "links.2.length": { "from": 40, "to": 60, "step": 5 },
            "input.angle": { "from": 40, "to": 110, "step": 5 },
            "fixed.O4[0]": { "from": 110, "to": 140, "step": 5 }
        }
    });
    let scene = linkgram::scene::read(&scene.to_string(), "scene.json").unwrap();
    let exam = linkgram::exam::draw(&scene, &terms(12, 2, Loose::PassOver), 1, &|_| {}).unwrap();
    for variant in &exam.variants {
        let own: Value = serde_json::from_str(&variant.text).unwrap();
        let number = |value: &Value| value.as_f64().unwrap();
        let pivot = [number(&own["fixed"]["O4"][0]), 10.0];
        let a = times(unit(number(&own["input"]["angle"])), number(&own["links"]["2"]["length"]));
        let across = minus(pivot, a);
        let d = long(across);
        let along = (110.0 * 110.0 - 6400.0 + d * d) / (2.0 * d);
        let u = times(across, 1.0 / d);
        let beside = (110.0 * 110.0 - along * along).sqrt();
        let b = plus(a, plus(times(u, along), times([-u[1], u[0]], beside)));
        let solved = linkgram::solve::solve(
            &variant.scene,
            linkgram::plan::Extent::WholeSkeleton,
            linkgram::sheet::scale::for_scene,
        );
        // At the scale of the figure on which centres are measured.
        let construction = solved.unwrap().solution.construction;
        let mm = 1e-3 / linkgram::sheet::smallest_lengths(&variant.scene, &construction);
        let lines = [([0.0; 2], a, b, minus(b, pivot)), (a, minus(b, a), [0.0; 2], pivot)];
        for (from, one, there, other) in lines {
            let sine = cross(one, other) / long(one) / long(other);
            assert!(sine.abs() >= 0.999 * libm::sin(15_f64.to_radians()), "{sine}: {}", variant.text);
            // The centre lies on the sheet beside the skeleton.
            let centre = plus(from, times(one, cross(minus(there, from), other) / cross(one, other)));
            for (axis, room) in [(0, 190.0), (1, 277.0)] {
                let all = [[0.0; 2], pivot, a, b, centre].map(|at| at[axis]);
                let most = all.iter().copied().fold(f64::MIN, f64::max);
                let least = all.iter().copied().fold(f64::MAX, f64::min);
                assert!((most - least) * mm <= room + 0.1, "{centre:?}: {}", variant.text);
            }
        }
    }
}

/// Points that all stand at one place have no direction: nothing says how their sheet lies.
#[test]
fn a_skeleton_on_one_spot_is_not_turned() {
    let scene = linkgram::scene::read(include_str!("../examples/s000-ch3a-1.json"), "scene.json").unwrap();
    let names = ["O2", "O4", "A", "B", "C", "D"];
    let spot: serde_json::Map<String, Value> =
        names.iter().map(|name| ((*name).to_owned(), json!([0, 0]))).collect();
    let report = graded(&scene, &json!({ "points": { "skeleton": spot } }));
    let text = report.to_text();
    assert!(!report.holds() && !text.contains("turned"), "{text}");
}
