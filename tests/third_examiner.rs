//! What a third examiner would not hand out: one misconception that costs two marks, what follows from nothing that was
//! handed in, and names that other answers of the same student contradict. The mechanisms are solved here by their loop
//! equations, with the mistake in them.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use linkgram::grade::{Kind, Report, Verdict};
use linkgram::scene::{self, Scene};
use serde_json::{Map, Value, json};

use crate::common::hand_in::graded;
use crate::common::plane::{Xy, cross, dot, long, minus, plus, times, unit};

pub(crate) fn read(scene: &Value) -> Scene {
    scene::read(&scene.to_string(), "scene.json").unwrap()
}

pub(crate) fn left(v: Xy) -> Xy {
    [-v[1], v[0]]
}

/// The numbers by which two vectors add up to a third.
pub(crate) fn resolve(target: Xy, [one, other]: [Xy; 2]) -> [f64; 2] {
    let det = cross(one, other);
    [cross(target, other) / det, cross(one, target) / det]
}

/// Four figures, as people write.
pub(crate) fn four(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap()
}

pub(crate) fn vector(v: Xy, unit: &str) -> Value {
    let degrees = libm::atan2(v[1], v[0]).to_degrees();
    json!({ "magnitude": format!("{} {unit}", four(long(v))), "direction": (degrees * 10.0).round() / 10.0 })
}

pub(crate) fn turning(value: f64, unit: &str) -> Value {
    json!({ "value": format!("{} {unit}", four(value.abs())), "sense": if value < 0.0 { "cw" } else { "ccw" } })
}

pub(crate) fn handed_in(values: Vec<(&str, Value)>) -> Map<String, Value> {
    values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

pub(crate) fn report(scene: &Value, values: &Map<String, Value>) -> Report {
    graded(&read(scene), &json!({ "values": values }))
}

pub(crate) fn wrong(report: &Report) -> Vec<&str> {
    let wrong = report.quantities.iter().filter(|one| one.verdict == Verdict::Wrong);
    wrong.map(|one| one.name.as_str()).collect()
}

pub(crate) fn verdict(report: &Report, name: &str) -> Verdict {
    report.quantities.iter().find(|one| one.name == name).unwrap().verdict
}

/// The first name of a wrong answer, with what was done.
pub(crate) fn named(report: &Report, name: &str) -> Option<(Kind, String)> {
    let graded = report.quantities.iter().find(|one| one.name == name).unwrap();
    graded.mistakes.first().map(|mistake| (mistake.kind, mistake.text().to_string()))
}

/// One fault, at this answer, of this kind.
pub(crate) fn one_fault(report: &Report, at: &str, kind: Kind) {
    assert_eq!(wrong(report), [at], "{}", report.to_text());
    assert_eq!(named(report, at).map(|(kind, _)| kind), Some(kind), "{}", report.to_text());
}

// --- a four-bar ----------------------------------------------------------------------------------

/// Crank 60 mm at 70°, coupler 150 mm with C at 110 and 80 mm from A and B, rocker 120 mm about (175, −20) mm.
pub(crate) struct FourBar {
    /// A, B and C.
    pub(crate) places: [Xy; 3],
    pub(crate) va: Xy,
    pub(crate) vb: Xy,
    pub(crate) vc: Xy,
    pub(crate) omega: [f64; 2],
    pub(crate) normal: [Xy; 2],
    pub(crate) aa: Xy,
    pub(crate) ab: Xy,
    pub(crate) ac: Xy,
    pub(crate) alpha: [f64; 2],
}

const RATE: f64 = 4.0 * std::f64::consts::PI;

impl FourBar {
    /// With a normal part of this size to a velocity and a length.
    pub(crate) fn with(size: impl Fn(f64, f64) -> f64) -> Self {
        let (a, pivot) = (times(unit(70_f64.to_radians()), 60.0), [175.0, -20.0]);
        let base = minus(pivot, a);
        let far = long(base);
        let along = (150.0 * 150.0 - 120.0 * 120.0 + far * far) / (2.0 * far);
        let up = libm::sqrt(150.0 * 150.0 - along * along);
        let b = plus(a, plus(times(base, along / far), times(left(base), up / far)));
        let (coupler, rocker) = (minus(b, a), minus(b, pivot));
        let ahead = (150.0 * 150.0 + 110.0 * 110.0 - 80.0 * 80.0) / (2.0 * 150.0);
        let beside = libm::sqrt(110.0 * 110.0 - ahead * ahead);
        let arms = [times(left(coupler), -1.0), left(rocker)];
        let va = times(left(a), RATE);
        let omega = resolve(va, arms);
        let normal = [
            times(coupler, -size(omega[0].abs() * 150.0, 150.0) / 150.0),
            times(rocker, -size(omega[1].abs() * 120.0, 120.0) / 120.0),
        ];
        let aa = times(a, -RATE * RATE);
        let alpha = resolve(minus(plus(aa, normal[0]), normal[1]), arms);
        let ab = plus(normal[1], times(left(rocker), alpha[1]));
        let vb = times(left(rocker), omega[1]);
        // Similar triangles on the coupler.
        let image = |from: Xy, to: Xy| {
            let d = minus(to, from);
            let [p, q] = [ahead / 150.0, beside / 150.0];
            plus(from, plus(times(d, p), times(left(d), q)))
        };
        let (vc, ac) = (image(va, vb), image(aa, ab));
        Self { places: [a, b, image(a, b)], va, vb, vc, omega, normal, aa, ab, ac, alpha }
    }

    pub(crate) fn scene() -> Value {
        json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [175, -20] },
            "links": { "2": { "joins": ["O2", "A"], "length": 60 },
                       "3": { "joins": ["A", "B", "C"], "sides": [150, 80, 110], "turn": "ccw" },
                       "4": { "joins": ["O4", "B"], "length": 120 } },
            "near": { "B": [150, 100] }, "input": { "link": 2, "angle": 70, "omega": "120 rpm ccw" },
            "find": ["v(B)", "omega(3)", "omega(4)", "v(C)", "an(B/A)", "an(B)", "a(B)", "alpha(3)", "alpha(4)", "a(C)"]
        })
    }

    /// All answers, the input so many times too fast.
    pub(crate) fn values(&self, faster: f64) -> Map<String, Value> {
        let square = faster * faster;
        let (v, a, w, e) = ("mm/s", "mm/s^2", "rad/s", "rad/s^2");
        handed_in(vec![
            ("v(B)", vector(times(self.vb, faster), v)),
            ("omega(3)", turning(self.omega[0] * faster, w)),
            ("omega(4)", turning(self.omega[1] * faster, w)),
            ("v(C)", vector(times(self.vc, faster), v)),
            ("an(B/A)", vector(times(self.normal[0], square), a)),
            ("an(B)", vector(times(self.normal[1], square), a)),
            ("a(B)", vector(times(self.ab, square), a)),
            ("alpha(3)", turning(self.alpha[0] * square, e)),
            ("alpha(4)", turning(self.alpha[1] * square, e)),
            ("a(C)", vector(times(self.ac, square), a)),
        ])
    }
}

pub(crate) fn squared(speed: f64, length: f64) -> f64 {
    speed * speed / length
}

#[test]
fn a_right_four_bar_is_right() {
    let right = FourBar::with(squared);
    let report = report(&FourBar::scene(), &right.values(1.0));
    assert_eq!(wrong(&report), [""; 0], "{}", report.to_text());
}

/// V/l for V²/l in every normal part, and all that follows drawn rightly: one misconception, one mark.
#[test]
fn one_wrong_formula_costs_one_mark_however_often_it_was_used() {
    let report = report(&FourBar::scene(), &FourBar::with(|speed, length| speed / length).values(1.0));
    one_fault(&report, "an(B)", Kind::WrongFormula);
    assert_eq!(verdict(&report, "an(B/A)"), Verdict::Consistent, "{}", report.to_text());
}

/// The input is 9.55 times too fast and all follows, but for one rate: the student's own V leaves one ω, his own
/// tangential part one ε, whatever lies about.
#[test]
fn what_follows_from_nothing_handed_in_does_not_follow() {
    let faster = 30.0 / std::f64::consts::PI;
    let own = FourBar::with(squared);
    let all = report(&FourBar::scene(), &own.values(faster));
    one_fault(&all, "omega(3)", Kind::RpmAsRad);
    for part in [0.5, 0.71, 1.35, 1.45, 2.1] {
        let mut values = own.values(faster);
        values.insert("omega(4)".into(), turning(own.omega[1] * faster * part, "rad/s"));
        let told = report(&FourBar::scene(), &values);
        assert_eq!(wrong(&told), ["omega(3)", "omega(4)"], "{part}: {}", told.to_text());
        let mut values = own.values(faster);
        values.insert("alpha(4)".into(), turning(own.alpha[1] * faster * faster * part, "rad/s^2"));
        let told = report(&FourBar::scene(), &values);
        assert_eq!(wrong(&told), ["omega(3)", "alpha(4)"], "{part}: {}", told.to_text());
        // Aⁿ follows rightly: nothing is said of it.
        let name = named(&told, "alpha(4)").map(|(_, text)| text).unwrap_or_default();
        assert!(!name.contains("Aⁿ") && !name.contains("an("), "{part}: {}", told.to_text());
    }
}

/// A rate that was calculated with twice the length of its link, or half of it, and nothing else.
#[test]
fn half_or_twice_a_length_is_named() {
    let own = FourBar::with(squared);
    for part in [0.5, 2.0] {
        let mut values = own.values(1.0);
        values.insert("omega(3)".into(), turning(own.omega[0] * part, "rad/s"));
        let told = report(&FourBar::scene(), &values);
        one_fault(&told, "omega(3)", Kind::TangentialWrongLength);
        let half = if part > 1.0 { "half" } else { "twice" };
        assert!(named(&told, "omega(3)").unwrap().1.contains(half), "{}", told.to_text());
    }
}

/// The number of another unit than stands beside it, one answer alone.
#[test]
fn a_unit_that_belongs_to_another_number_is_named() {
    let own = FourBar::with(squared);
    let mut values = own.values(1.0);
    values.insert("omega(3)".into(), turning(own.omega[0], "rpm"));
    one_fault(&report(&FourBar::scene(), &values), "omega(3)", Kind::RadAsRpm);
    let mut values = own.values(1.0);
    values.insert("v(B)".into(), vector(times(own.vb, 0.1), "mm/s"));
    one_fault(&report(&FourBar::scene(), &values), "v(B)", Kind::CmAsMm);
}

// --- lengths on paper ------------------------------------------------------------------------------

/// Lengths of a drawing whose velocities are at 8 mm/s and whose accelerations are at 100 mm/s² per mm.
fn lengths(own: &FourBar, spoilt: f64) -> Value {
    let mm = |v: Xy, scale: f64| json!((long(v) / scale * 10.0).round() / 10.0);
    json!({
        "v(B)": mm(times(own.vb, spoilt), 8.0), "v(C)": mm(own.vc, 8.0),
        "an(B)": mm(own.normal[1], 100.0), "an(B/A)": mm(own.normal[0], 100.0),
        "a(B)": mm(own.ab, 100.0), "a(C)": mm(own.ac, 100.0),
    })
}

/// No scale is stated: the lengths are compared at their own, and that is told.
#[test]
fn lengths_without_a_scale_are_compared_at_their_own() {
    let own = FourBar::with(squared);
    let told = graded(&read(&FourBar::scene()), &json!({ "lengths": lengths(&own, 1.0) }));
    assert_eq!(wrong(&told), [""; 0], "{}", told.to_text());
    assert_eq!(told.sum().0, 6.0, "{}", told.to_text());
    let scales: Vec<(f64, bool)> = told.scales.iter().map(|scale| (scale.per_mm, scale.own)).collect();
    let near = |(own, is_own): (f64, bool), right: f64| is_own && (own / right - 1.0).abs() < 0.02;
    assert!(scales.len() == 2 && near(scales[0], 8.0) && near(scales[1], 100.0), "{scales:?}");
    assert!(told.to_text().contains("No scale is stated for the velocities"), "{}", told.to_text());
    // Nothing of it where the scale is stated.
    let stated = json!({ "velocity": "8 mm/s per mm", "acceleration": "100 mm/s^2 per mm" });
    let told = graded(&read(&FourBar::scene()), &json!({ "lengths": lengths(&own, 1.0), "scales": stated }));
    assert!(wrong(&told).is_empty() && told.scales.is_empty(), "{}", told.to_text());
    // One of two lengths is wrong: nobody knows at which scale, and that of the sheet is told.
    let told = graded(&read(&FourBar::scene()), &json!({ "lengths": lengths(&own, 1.3) }));
    let of_velocities = told.scales.iter().find(|scale| !scale.own).unwrap();
    assert!(told.to_text().contains("the sheet's"), "{}", told.to_text());
    assert_eq!(of_velocities.unit.symbol, "mm/s");
}

/// Drawn at half the scale that is stated: one fault, with its name.
#[test]
fn a_drawing_at_another_scale_than_stated_is_named() {
    let own = FourBar::with(squared);
    let stated = json!({ "velocity": "16 mm/s per mm", "acceleration": "100 mm/s^2 per mm" });
    let told = graded(&read(&FourBar::scene()), &json!({ "lengths": lengths(&own, 1.0), "scales": stated }));
    one_fault(&told, "v(B)", Kind::ScaleWrong);
}

// --- a slotted lever ---------------------------------------------------------------------------------

/// Crank 110 mm at 35°, 60 rpm; the lever of 520 mm turns about (0, −260) mm, a rod of 160 mm leads to a ram at y = 240 mm.
struct Shaper {
    omega: f64,
    alpha: f64,
    vc: Xy,
    vd: f64,
    under: Xy,
    ad: f64,
}

impl Shaper {
    /// With so many times Coriolis, and V of the point under the pin for V_C, or in its proportion.
    fn with(coriolis: f64, in_proportion: bool) -> Self {
        let rate = 2.0 * std::f64::consts::PI;
        let a = times(unit(35_f64.to_radians()), 110.0);
        let arm = plus(a, [0.0, 260.0]);
        let long_arm = long(arm);
        let e = times(arm, 1.0 / long_arm);
        let va = times(left(a), rate);
        let (omega, slip) = (dot(va, left(e)) / long_arm, dot(va, e));
        let whole = times(a, -rate * rate);
        let alpha = (dot(whole, left(e)) - coriolis * 2.0 * omega * slip) / long_arm;
        let under = times(left(e), omega * long_arm);
        let vc = times(under, if in_proportion { 520.0 / long_arm } else { 1.0 });
        let c = plus([0.0, -260.0], times(e, 520.0));
        let rod = [-libm::sqrt(160.0 * 160.0 - (240.0 - c[1]) * (240.0 - c[1])), 240.0 - c[1]];
        let turn = -vc[1] / rod[0];
        let vd = vc[0] - turn * rod[1];
        let ac = plus(times(e, -omega * omega * 520.0), times(left(e), alpha * 520.0));
        let known = plus(ac, times(rod, -turn * turn));
        let beta = -known[1] / rod[0];
        Self { omega, alpha, vc, vd, under, ad: known[0] - beta * rod[1] }
    }

    fn scene(find: &[&str]) -> Value {
        json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, -260] },
            "links": { "2": { "joins": ["O2", "A"], "length": 110 }, "4": { "joins": ["O4", "C"], "length": 520 },
                       "5": { "joins": ["C", "D"], "length": 160 } },
            "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "C" } },
                        { "pin": "D", "block": 6, "on": { "link": 1, "through": [0, 240], "angle": 0 } } ],
            "near": { "C": [170, 230], "D": [0, 240] },
            "input": { "link": 2, "angle": 35, "omega": "60 rpm ccw" }, "find": find
        })
    }
}

/// Only the last answers are handed in: of what leads to them the commoner mistake is named, and none of velocities, of
/// which nothing is seen.
#[test]
fn coriolis_turned_the_wrong_way_is_named_by_what_follows_alone() {
    let scene = Shaper::scene(&["v(A@4)", "omega(4)", "coriolis(A/4)", "alpha(4)", "a(D)"]);
    let check = |coriolis: f64| {
        let own = Shaper::with(coriolis, true);
        let values = handed_in(vec![
            ("alpha(4)", turning(own.alpha, "rad/s^2")),
            ("a(D)", vector([own.ad, 0.0], "mm/s^2")),
        ]);
        report(&scene, &values)
    };
    let right = check(1.0);
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    one_fault(&check(-1.0), "alpha(4)", Kind::CoriolisWrongTurn);
}

/// V of the lever's point under the pin handed in for that of its end.
#[test]
fn a_velocity_without_its_proportion_is_named() {
    let scene = Shaper::scene(&["v(A@4)", "omega(4)", "v(C)", "v(D)"]);
    let own = Shaper::with(1.0, false);
    let values = handed_in(vec![
        ("v(A@4)", vector(own.under, "mm/s")),
        ("omega(4)", turning(own.omega, "rad/s")),
        ("v(C)", vector(own.vc, "mm/s")),
        ("v(D)", vector([own.vd, 0.0], "mm/s")),
    ]);
    one_fault(&report(&scene, &values), "v(C)", Kind::NeighbourRead);
}

/// A rod of 320 mm slides through a block that turns about (180, −60) mm; the line for the point of the rod in the block
/// is drawn square to the rod, V of its end by proportion on that image.
#[test]
fn an_image_by_proportion_beyond_what_slides_follows() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [180, -60] },
        "links": { "2": { "joins": ["O2", "A"], "length": 70 }, "3": { "joins": ["A", "B"], "length": 320 } },
        "slides": [ { "pin": "O4", "block": 4, "on": { "link": 3, "through": "A", "toward": "B" } } ],
        "near": { "B": [330, -120] }, "input": { "link": 2, "angle": 65, "omega": "15 rad/s cw" },
        "find": ["omega(3)", "v(O4@3)", "v(B)"]
    });
    let a = times(unit(65_f64.to_radians()), 70.0);
    let va = times(left(a), -15.0);
    let arm = minus([180.0, -60.0], a);
    let e = times(arm, 1.0 / long(arm));
    let check = |parallel: bool| {
        // Rightly the point of the rod in the block moves along the rod.
        let under = if parallel { times(left(e), dot(va, left(e))) } else { times(e, dot(va, e)) };
        let relative = minus(under, va);
        let size = long(relative) / long(arm);
        // A velocity along its arm turns it neither way: he takes the sense of the crank.
        let rate = if parallel { -size } else { size * cross(arm, relative).signum() };
        let vb = plus(va, times(relative, 320.0 / long(arm)));
        let values = handed_in(vec![
            ("v(O4@3)", vector(under, "mm/s")),
            ("omega(3)", turning(rate, "rad/s")),
            ("v(B)", vector(vb, "mm/s")),
        ]);
        report(&scene, &values)
    };
    let right = check(false);
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    one_fault(&check(true), "v(O4@3)", Kind::PerpendicularForParallel);
}

// --- forces ------------------------------------------------------------------------------------------

/// A wheel of 25 kg and 0.3 kg m² on a rail, moved by a crank of 100 mm and a rod of 400 mm; the weight forgotten. The rail
/// would have to pull, which nobody asks who forgot it.
#[test]
fn a_weight_left_out_is_named_where_the_contact_would_have_to_pull() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 100 }, "3": { "joins": ["A", "B"], "length": 400 },
                   "4": { "joins": ["B"] } },
        "rolls": [ { "links": [1, 4], "line": { "link": 1, "through": [0, -150], "angle": 0 }, "centre": "B",
                     "radius": 150 } ],
        "near": { "B": [450, 0] }, "input": { "link": 2, "angle": 60, "omega": "8 rad/s ccw" }, "gravity": {},
        "masses": { "4": { "mass": 25, "at": "B", "inertia": 0.3 } }, "find": ["a(B)", "F(3,4)", "F(1,4)"]
    });
    let a = times(unit(60_f64.to_radians()), 0.1);
    let rod = [libm::sqrt(0.16 - a[1] * a[1]), -a[1]];
    let turn = -8.0 * a[0] / rod[0];
    let beta = (64.0 * a[1] + turn * turn * rod[1]) / rod[0];
    let ab = -64.0 * a[0] - turn * turn * rod[0] - beta * rod[1];
    // About the contact: (F₃₄ + Fⁱⁿ) · 0.15 against −I·α, with F₃₄ along the rod.
    let (inertia, alpha) = (-25.0 * ab, -ab / 0.15);
    let across = -inertia - 0.3 * alpha / 0.15;
    let rod_force = [across, across * rod[1] / rod[0]];
    for (weight, fault) in [(25.0 * 9.806_65, false), (0.0, true)] {
        let rail = times(plus(rod_force, [inertia, -weight]), -1.0);
        let values = handed_in(vec![
            ("a(B)", vector([ab, 0.0], "m/s^2")),
            ("F(3,4)", vector(rod_force, "N")),
            ("F(1,4)", vector(rail, "N")),
        ]);
        let told = report(&scene, &values);
        match fault {
            true => one_fault(&told, "F(1,4)", Kind::ForceLeftOut),
            false => assert_eq!(wrong(&told), [""; 0], "{}", told.to_text()),
        }
    }
}

/// A press at rest: crank 80 mm at 50°, rod 260 mm with 300 N at 100 mm from A, 1500 N on the slider; its weight in the
/// middle of the rod.
#[test]
fn a_mass_centre_in_the_middle_is_named() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 80 }, "3": { "joins": ["A", "G", "B"], "line": [0, 100, 260] } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O" } } ], "near": { "B": [200, 0] },
        "input": { "link": 2, "angle": 50 }, "gravity": {}, "masses": { "3": { "weight": "300 N", "at": "G" } },
        "loads": [ { "on": 4, "at": "B", "force": "1500 N", "direction": 180 } ],
        "find": ["F(1,4)", "F(3,4)", "F(2,3)"]
    });
    let a = times(unit(50_f64.to_radians()), 80.0);
    let rod = [libm::sqrt(260.0 * 260.0 - a[1] * a[1]), -a[1]];
    let check = |far: f64| {
        // Moments of the rod about A: B's force −F₃₄ and the weight.
        let up = (rod[1] * 1500.0 - 300.0 * rod[0] * far / 260.0) / rod[0];
        let values = handed_in(vec![
            ("F(3,4)", vector([1500.0, up], "N")),
            ("F(1,4)", vector([0.0, -up], "N")),
            ("F(2,3)", vector([1500.0, up + 300.0], "N")),
        ]);
        report(&scene, &values)
    };
    let right = check(100.0);
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    one_fault(&check(130.0), "F(1,4)", Kind::PointLaidOff);
}

/// A rough guide: its force is handed in square to it, all else with friction.
#[test]
fn a_force_of_a_guide_without_its_friction_is_named() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 80 }, "3": { "joins": ["A", "B"], "length": 260 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O" }, "f": 0.2 } ],
        "near": { "B": [300, 0] }, "input": { "link": 2, "angle": 50, "omega": "10 rad/s ccw" },
        "loads": [ { "on": 4, "at": "B", "force": "1500 N", "direction": 180 } ],
        "find": ["F(3,4)", "F(1,4)", "F(2,3)"]
    });
    // The slider moves to the left, the rod pushes it to the right and down.
    let lean = libm::asin(80.0 * libm::sin(50_f64.to_radians()) / 260.0);
    let push = 1500.0 / (libm::cos(lean) + 0.2 * libm::sin(lean));
    let rod = [push * libm::cos(lean), -push * libm::sin(lean)];
    let press = push * libm::sin(lean);
    for (friction, fault) in [(0.2 * press, false), (0.0, true)] {
        let values = handed_in(vec![
            ("F(3,4)", vector(rod, "N")),
            ("F(1,4)", vector([friction, press], "N")),
            ("F(2,3)", vector(rod, "N")),
        ]);
        let told = report(&scene, &values);
        match fault {
            true => one_fault(&told, "F(1,4)", Kind::FrictionLeftOut),
            false => assert_eq!(wrong(&told), [""; 0], "{}", told.to_text()),
        }
    }
}

/// A four-bar with inertia, by its loop equations and moments about O4 and A.
fn inertia(mistake: &str) -> Report {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [220, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 70 }, "3": { "joins": ["A", "G3", "B"], "line": [0, 90, 240] },
                   "4": { "joins": ["O4", "G4", "B"], "line": [0, 75, 150] } },
        "near": { "B": [260, 140] }, "input": { "link": 2, "angle": 75, "omega": "25 rad/s ccw" },
        "masses": { "3": { "mass": 4, "at": "G3", "inertia": 0.03 }, "4": { "mass": 3, "at": "G4", "inertia": 0.012 } },
        "find": ["Fin(3)", "Tin(3)", "h(3)", "Fin(4)", "Tin(4)", "F(3,4)", "F(1,4)", "F(2,3)"]
    });
    let a = times(unit(75_f64.to_radians()), 0.07);
    let base = minus([0.22, 0.0], a);
    let far = long(base);
    let along = (0.24 * 0.24 - 0.15 * 0.15 + far * far) / (2.0 * far);
    let up = libm::sqrt(0.24 * 0.24 - along * along);
    let three = plus(times(base, along / far), times(left(base), up / far));
    let four = minus(plus(a, three), [0.22, 0.0]);
    let arms = [times(left(three), -1.0), left(four)];
    let [w3, w4] = resolve(times(left(a), 25.0), arms);
    let aa = times(a, -625.0);
    let [e3, e4] = resolve(plus(plus(aa, times(three, -w3 * w3)), times(four, w4 * w4)), arms);
    let of = |arm: Xy, w: f64, e: f64| plus(times(arm, -w * w), times(left(arm), e));
    let ab = of(four, w4, e4);
    let to_mass = times(three, 90.0 / 240.0);
    let (g3, g4) = (plus(aa, of(to_mass, w3, e3)), times(ab, 0.5));
    let sign = if mistake == "all with the acceleration" { 1.0 } else { -1.0 };
    let taken = if mistake == "that of B" { ab } else { g3 };
    let (f3, f4) = (times(taken, 4.0 * sign), times(g4, 3.0 * sign));
    let (t3, t4) = (0.03 * e3 * sign, 0.012 * e4 * sign);
    let moments =
        [cross(times(four, 0.5), f4) + t4, cross(to_mass, f3) + if mistake == "h" { -t3 } else { t3 }];
    // r₄ × F₃₄ = −M₄ and r₃ × F₃₄ = M₃.
    let det = cross(four, three);
    let f34 = [0, 1].map(|axis| (-moments[0] * three[axis] - moments[1] * four[axis]) / det);
    let f14 = times(plus(f34, f4), -1.0);
    let values = handed_in(vec![
        ("Fin(3)", vector(f3, "N")),
        ("Tin(3)", turning(t3, "N*m")),
        ("h(3)", json!(format!("{} mm", self::four((t3 / long(f3)).abs() * 1e3)))),
        ("Fin(4)", vector(f4, "N")),
        ("Tin(4)", turning(t4, "N*m")),
        ("F(3,4)", vector(f34, "N")),
        ("F(1,4)", vector(f14, "N")),
        ("F(2,3)", vector(minus(f34, f3), "N")),
    ]);
    report(&scene, &values)
}

#[test]
fn mistakes_with_inertia_cost_one_mark_and_have_their_names() {
    let right = inertia("");
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    one_fault(&inertia("all with the acceleration"), "Fin(3)", Kind::InertiaAlongAcceleration);
    let told = inertia("that of B");
    one_fault(&told, "Fin(3)", Kind::WrongFormula);
    assert!(told.to_text().contains("with the acceleration of B"), "{}", told.to_text());
    one_fault(&inertia("h"), "F(3,4)", Kind::OffsetOtherSide);
}
