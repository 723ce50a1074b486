//! What a fourth examiner would not hand out: a letter that costs the whole drawing, a drawing that is judged by a scale that
//! nobody stated, names that what was handed in contradicts, and mistakes that every examiner knows by name. The mechanisms
//! are solved here by their loop equations and by moments, with the mistake in them.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::f64::consts::PI;

use linkgram::grade::{HandIn, Kind, Report, Verdict, class_csv};
use serde_json::{Map, Value, json};

use crate::common::hand_in::{SLIDER, closed, graded, slider};
use crate::common::plane::{Xy, cross, dot, long, minus, plus, times, turned, unit};
use crate::third_examiner::{
    FourBar, four, handed_in, left, named, one_fault, read, report, resolve, squared, turning, vector,
    verdict, wrong,
};

// --- drawings ------------------------------------------------------------------------------------

/// A four-bar and what is asked of it.
fn asked() -> Value {
    let mut scene = FourBar::scene();
    scene["find"] = json!(["v(B)", "v(C)", "a(B)", "a(C)"]);
    scene
}

/// The figures of a four-bar, mm on paper: one to two, 8 mm/s and 100 mm/s² per mm, so many times as large.
fn figures(own: &FourBar, larger: [f64; 3]) -> [Vec<(&'static str, Xy)>; 3] {
    let [a, b, c] = own.places;
    let on_paper = |at: Xy, scale: f64, larger: f64| times(at, larger / scale);
    let [s, v, w] = larger;
    [
        vec![("O2", [0.0; 2]), ("O4", [175.0, -20.0]), ("A", a), ("B", b), ("C", c)]
            .into_iter()
            .map(|(name, at)| (name, on_paper(at, 2.0, s)))
            .collect(),
        vec![("o", [0.0; 2]), ("a", own.va), ("b", own.vb), ("c", own.vc)]
            .into_iter()
            .map(|(name, at)| (name, on_paper(at, 8.0, v)))
            .collect(),
        vec![("o'", [0.0; 2]), ("a'", own.aa), ("b'", own.ab), ("c'", own.ac)]
            .into_iter()
            .map(|(name, at)| (name, on_paper(at, 100.0, w)))
            .collect(),
    ]
}

fn points(of: &[(&str, Xy)]) -> Value {
    let points: Map<String, Value> = of.iter().map(|(name, at)| ((*name).to_owned(), json!(at))).collect();
    points.into()
}

/// As the SVG of a vector editor: dots, and letters of 4 mm beside them but for one that stands too far away.
fn svg(figures: &[Vec<(&str, Xy)>; 3], far: &str) -> String {
    let mut inside = String::new();
    for (figure, from) in figures.iter().zip([[60.0, 200.0], [400.0, 200.0], [400.0, 500.0]]) {
        for (name, [x, y]) in figure {
            let [x, y] = [from[0] + x, from[1] - y];
            let beside = if *name == far { 60.0 } else { 1.0 };
            inside += &format!(r#"<circle cx="{x}" cy="{y}" r="0.5"/>"#);
            let [x, y] = [x + beside, y - 1.0];
            inside += &format!(r#"<text x="{x}" y="{y}" font-size="4">{name}</text>"#);
        }
    }
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="900mm" height="900mm" viewBox="0 0 900 900">{inside}</svg>"#
    )
}

fn with_drawing(svg: &str) -> Report {
    let scene = read(&asked());
    let stated = json!({
        "scales": { "length": "2 mm per mm", "velocity": "8 mm/s per mm", "acceleration": "100 mm/s^2 per mm" },
        "drawing": "own.svg"
    });
    let mut answers = linkgram::grade::read_answers(&stated.to_string(), &scene).unwrap();
    answers.add_drawing(svg, "own.svg", &scene).unwrap();
    linkgram::grade::grade(&scene, &answers, &linkgram::grade::GradeSettings::default()).unwrap()
}

/// A letter that stands too far from its mark, or names two marks, leaves its own answer open and no other.
#[test]
fn a_letter_that_nobody_can_read_costs_its_own_mark() {
    let own = figures(&FourBar::with(squared), [1.0; 3]);
    let whole = with_drawing(&svg(&own, ""));
    assert_eq!((wrong(&whole), whole.sum()), (vec![], (4.0, 4.0)), "{}", whole.to_text());
    // The skeleton's C brings no mark itself, the velocity polygon's c one.
    for (letter, name, reached) in [("C", "skeleton:C", 4.0), ("c", "velocity:c", 3.0)] {
        let told = with_drawing(&svg(&own, letter));
        let unread: Vec<&str> = told.not_read.iter().map(|one| one.name.as_str()).collect();
        assert_eq!((unread, wrong(&told)), (vec![name], vec![]), "{}", told.to_text());
        assert_eq!(told.sum(), (reached, 4.0), "{}", told.to_text());
        assert!(told.not_read[0].why.to_string().starts_with("own.svg:1:"), "{}", told.not_read[0].why);
    }
    let mut twice = own.clone();
    twice[1].push(("c", [30.0, -40.0]));
    let told = with_drawing(&svg(&twice, ""));
    assert_eq!((told.sum(), told.not_read.len()), ((3.0, 4.0), 1), "{}", told.to_text());
    assert!(told.to_text().contains("`c` names two points"), "{}", told.to_text());
}

fn at_own_scale(larger: [f64; 3], spoil: impl FnOnce(&mut [Vec<(&'static str, Xy)>; 3])) -> Report {
    let mut own = figures(&FourBar::with(squared), larger);
    spoil(&mut own);
    let [skeleton, velocity, acceleration] = &own;
    let figures = json!({
        "skeleton": points(skeleton), "velocity": points(velocity), "acceleration": points(acceleration)
    });
    graded(&read(&asked()), &json!({ "points": figures }))
}

/// No scale is stated: every figure is compared at its own, and that is told.
#[test]
fn a_polygon_without_a_scale_is_compared_at_its_own() {
    let whole = [0.61, 1.7, 0.45];
    let told = at_own_scale(whole, |_| {});
    assert_eq!((wrong(&told), told.sum()), (vec![], (4.0, 4.0)), "{}", told.to_text());
    let scales: Vec<(f64, bool)> = told.scales.iter().map(|scale| (scale.per_mm, scale.own)).collect();
    let near = |(own, is_own): (f64, bool), right: f64| is_own && (own / right - 1.0).abs() < 0.02;
    assert!(scales.len() == 2 && near(scales[0], 8.0 / 1.7) && near(scales[1], 100.0 / 0.45), "{scales:?}");
    assert!(told.to_text().contains("No scale is stated for the velocities"), "{}", told.to_text());
    // One point elsewhere is one fault at any scale.
    let told = at_own_scale(whole, |figures| figures[1][3].1 = plus(figures[1][3].1, [9.0, -14.0]));
    assert_eq!(wrong(&told), ["velocity:c"], "{}", told.to_text());
    // Revolutions a minute for rad/s enlarge one polygon by 9.55 and the other by its square: that is no scale.
    let faster = 30.0 / PI;
    let scale = 1.0 / 40.0;
    let told = at_own_scale([1.0, faster * scale, faster * faster * scale], |_| {});
    assert!(told.scales.iter().all(|scale| scale.own) || !told.holds(), "{}", told.to_text());
}

/// The same of a skeleton with one fixed point: crank and slider tell its scale together.
#[test]
fn a_skeleton_with_one_fixed_point_is_compared_at_its_own_scale() {
    let right = closed(30.0, 60_f64.to_radians(), 1.0);
    for larger in [0.57, 1.8] {
        let mm = |at: Xy| json!(times(at, 2.0 * larger));
        let skeleton = json!({ "O2": [0, 0], "A": mm(right.a), "B": mm(right.b) });
        let told = graded(&slider(), &json!({ "points": { "skeleton": skeleton } }));
        assert_eq!(wrong(&told), [""; 0], "{}", told.to_text());
    }
    // A crank that is laid off otherwise is no scale.
    let longer = closed(36.0, 60_f64.to_radians(), 1.0);
    let mm = |at: Xy| json!(at.map(|x| x * 2.0));
    let skeleton = json!({ "O2": [0, 0], "A": mm(longer.a), "B": mm(longer.b) });
    let scales = json!({ "length": "0.5 cm per mm" });
    let told = graded(&slider(), &json!({ "points": { "skeleton": skeleton }, "scales": scales }));
    assert_eq!(wrong(&told), ["skeleton:A"], "{SLIDER}: {}", told.to_text());
}

/// C on the other side of AB, and both polygons drawn after that.
#[test]
fn a_point_on_the_other_side_of_its_link_is_named() {
    let own = FourBar::with(squared);
    let [a, b, c] = own.places;
    let mirrored = |from: Xy, to: Xy, at: Xy| {
        let line = minus(to, from);
        let along = dot(minus(at, from), line) / dot(line, line);
        minus(plus(from, plus(from, times(line, 2.0 * along))), at)
    };
    let other = FourBar {
        places: [a, b, mirrored(a, b, c)],
        vc: mirrored(own.va, own.vb, own.vc),
        ac: mirrored(own.aa, own.ab, own.ac),
        ..own
    };
    let drawn = figures(&other, [1.0; 3]);
    let stated = json!({
        "scales": { "length": "2 mm per mm", "velocity": "8 mm/s per mm", "acceleration": "100 mm/s^2 per mm" },
        "points": { "skeleton": points(&drawn[0]), "velocity": points(&drawn[1]), "acceleration": points(&drawn[2]) }
    });
    let told = graded(&read(&asked()), &stated);
    one_fault(&told, "skeleton:C", Kind::PointLaidOff);
    assert!(named(&told, "skeleton:C").unwrap().1.contains("on the other side of AB"), "{}", told.to_text());
}

/// A drawing of which all points are one tells no unit and no scale.
#[test]
fn points_that_are_all_one_have_no_name() {
    let all = |names: &[&str]| -> Value {
        let points: Map<String, Value> =
            names.iter().map(|name| ((*name).to_owned(), json!([0, 0]))).collect();
        points.into()
    };
    let told =
        graded(&read(&asked()), &json!({ "points": { "skeleton": all(&["O2", "O4", "A", "B", "C"]) } }));
    let of_units = [Kind::MetreMixed, Kind::CmAsMm, Kind::ScaleWrong, Kind::ScaleForgotten];
    let kinds = told.quantities.iter().flat_map(|one| one.mistakes.iter().map(|mistake| mistake.kind));
    assert!(kinds.into_iter().all(|kind| !of_units.contains(&kind)), "{}", told.to_text());
}

// --- motion --------------------------------------------------------------------------------------

/// V_C alone has feet where all else has inches.
#[test]
fn a_unit_that_no_other_answer_has_is_named() {
    // The four-bar in inches: 25 mm of it for one.
    let mut scene = asked();
    scene["units"] = json!({ "length": "in" });
    scene["fixed"] = json!({ "O2": [0, 0], "O4": [7, -0.8] });
    scene["links"] = json!({
        "2": { "joins": ["O2", "A"], "length": 2.4 },
        "3": { "joins": ["A", "B", "C"], "sides": [6, 3.2, 4.4], "turn": "ccw" },
        "4": { "joins": ["O4", "B"], "length": 4.8 }
    });
    scene["near"] = json!({ "B": [6, 4] });
    let own = FourBar::with(squared);
    let inches = |v: Xy| times(v, 0.04);
    for scale in [None, Some("0.4 in/s per mm")] {
        let values = handed_in(vec![
            ("v(B)", vector(inches(own.vb), "in/s")),
            ("v(C)", vector(inches(own.vc), "ft/s")),
            ("a(B)", vector(inches(own.ab), "in/s^2")),
            ("a(C)", vector(inches(own.ac), "in/s^2")),
        ]);
        let mut answers = json!({ "values": values });
        if let Some(scale) = scale {
            answers["scales"] = json!({ "velocity": scale });
        }
        one_fault(&graded(&read(&scene), &answers), "v(C)", Kind::InchAsFoot);
    }
}

/// The image of C on the line AB in both polygons, and A_B with its normal part outward between: the one misconception costs
/// one mark, the other another one.
#[test]
fn one_mistake_costs_one_mark_beside_another() {
    let own = FourBar::with(squared);
    let right = own.values(1.0);
    let on_line = |from: Xy, to: Xy| plus(from, times(minus(to, from), 110.0 / 150.0));
    let (four, three) = (minus(own.places[1], [175.0, -20.0]), minus(own.places[1], own.places[0]));
    let [w3, w4] = own.omega;
    let outward = times(four, w4 * w4);
    let known = minus(plus(own.aa, times(three, -w3 * w3)), outward);
    let [e3, e4] = resolve(known, [times(left(three), -1.0), left(four)]);
    let ab = plus(outward, times(left(four), e4));
    let mut values = right;
    values.insert("v(C)".into(), vector(on_line(own.va, own.vb), "mm/s"));
    values.insert("an(B)".into(), vector(outward, "mm/s^2"));
    values.insert("a(B)".into(), vector(ab, "mm/s^2"));
    values.insert("alpha(3)".into(), turning(e3, "rad/s^2"));
    values.insert("alpha(4)".into(), turning(e4, "rad/s^2"));
    values.insert("a(C)".into(), vector(on_line(own.aa, ab), "mm/s^2"));
    let told = report(&FourBar::scene(), &values);
    assert_eq!(wrong(&told), ["v(C)", "an(B)"], "{}", told.to_text());
    assert_eq!(verdict(&told, "a(C)"), Verdict::Consistent, "{}", told.to_text());
}

/// The letter of the sheet stands in the hints.
#[test]
fn hints_have_the_letter_of_the_sheet() {
    let own = FourBar::with(squared);
    let mut values = own.values(1.0);
    values.insert("omega(3)".into(), turning(own.omega[0] * 2.0, "rad/s"));
    for (symbols, letter, other) in [("alpha", 'α', 'ε'), ("epsilon", 'ε', 'α')] {
        let mut scene = FourBar::scene();
        scene["sheet"] = json!({ "symbols": symbols });
        let told = report(&scene, &values).to_text();
        assert!(told.contains(&format!("ω or {letter} and the length")) && !told.contains(other), "{told}");
    }
}

/// The table of a class has the columns of what is asked, however somebody writes it.
#[test]
fn a_class_has_one_column_for_what_is_asked() {
    let own = FourBar::with(squared);
    let mut values = own.values(1.0);
    let vb = values.remove("v(B)").unwrap();
    let mut other = values.clone();
    values.insert("v(B)".into(), vb.clone());
    other.insert("V_B".into(), vb);
    let hand_in = |file: &str, values: &Map<String, Value>| HandIn {
        file: file.to_owned(),
        outcome: Ok(report(&FourBar::scene(), values)),
    };
    let table = class_csv(&[hand_in("one.json", &values), hand_in("two.json", &other)]);
    let head = table.lines().next().unwrap();
    assert!(head.contains("v(B)") && !head.contains("V_B"), "{table}");
    let rows: Vec<String> = table.lines().skip(1).map(|line| line.replace("two.json", "one.json")).collect();
    assert_eq!(rows[0], rows[1], "{table}");
}

/// A wheel of 300 mm on a line pulls a rod of 700 mm on a guide 550 mm above it by a pin 200 mm from its centre.
fn wheel(mistake: &str) -> Report {
    let scene = json!({
        "units": { "length": "cm" }, "fixed": {}, "placed": { "C": [0, 30] },
        "links": { "2": { "joins": ["C", "P"], "length": 20 }, "3": { "joins": ["P", "D"], "length": 70 } },
        "rolls": [ { "links": [1, 2], "line": { "through": [0, 0], "angle": 0 }, "centre": "C", "radius": 30 } ],
        "slides": [ { "pin": "D", "block": 4, "on": { "link": 1, "through": [0, 55], "angle": 0 } } ],
        "near": { "D": [80, 55] },
        "input": { "link": 2, "angle": -40, "omega": "4 rad/s cw", "alpha": "6 rad/s^2 ccw" },
        "find": ["v(P)", "v(D)", "omega(3)", "a(P)", "a(D)", "alpha(3)"]
    });
    let (omega, alpha) = (-4.0, 6.0);
    let arm = times(unit(-40_f64.to_radians()), 20.0);
    let p = plus([0.0, 30.0], arm);
    let rod = {
        let up = 55.0 - p[1];
        [libm::sqrt(70.0 * 70.0 - up * up), up]
    };
    let radius = if mistake == "diameter" { 60.0 } else { 30.0 };
    let vp = plus([-omega * radius, 0.0], turned(omega, arm));
    let w3 = -vp[1] / rod[0];
    let vd = vp[0] - w3 * rod[1];
    let ap = match mistake {
        "about the contact" => plus(turned(alpha, p), times(p, -omega * omega)),
        _ => plus([-alpha * radius, 0.0], plus(turned(alpha, arm), times(arm, -omega * omega))),
    };
    let known = plus(ap, times(rod, -w3 * w3));
    let e3 = -known[1] / rod[0];
    let ad = known[0] - e3 * rod[1];
    report(
        &scene,
        &handed_in(vec![
            ("v(P)", vector(vp, "cm/s")),
            ("v(D)", vector([vd, 0.0], "cm/s")),
            ("omega(3)", turning(w3, "rad/s")),
            ("a(P)", vector(ap, "cm/s^2")),
            ("a(D)", vector([ad, 0.0], "cm/s^2")),
            ("alpha(3)", turning(e3, "rad/s^2")),
        ]),
    )
}

#[test]
fn mistakes_at_a_rolling_wheel_cost_one_mark_and_have_their_names() {
    let right = wheel("");
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    one_fault(&wheel("diameter"), "v(P)", Kind::DiameterForRadius);
    let told = wheel("about the contact");
    one_fault(&told, "a(P)", Kind::WrongFormula);
    assert!(named(&told, "a(P)").unwrap().1.contains("the point of contact"), "{}", told.to_text());
}

/// Where two circles meet, on this side.
fn meet(a: Xy, r: f64, b: Xy, s: f64, near: Xy) -> Xy {
    let base = minus(b, a);
    let far = long(base);
    let along = (r * r - s * s + far * far) / (2.0 * far);
    let up = libm::sqrt(r * r - along * along);
    let foot = plus(a, times(base, along / far));
    let both = [1.0, -1.0].map(|side| plus(foot, times(left(base), side * up / far)));
    if long(minus(both[0], near)) < long(minus(both[1], near)) { both[0] } else { both[1] }
}

/// Where two lines meet, each through two points.
fn crossing([a, b]: [Xy; 2], [c, d]: [Xy; 2]) -> Xy {
    let [part, _] = resolve(minus(c, a), [minus(b, a), minus(d, c)]);
    plus(a, times(minus(b, a), part))
}

/// A six-bar by instant centres.
fn centres(mistake: &str) -> Report {
    let find = ["v(B)", "omega(3)", "omega(4)", "v(E)", "omega(6)"];
    let mut asked = vec![json!("I(1,3)"), json!("I(1,5)")];
    asked.extend(find.map(|name| json!({ "name": name, "method": "centres" })));
    let scene = json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [18, -2], "O6": [40, 3] },
        "links": { "2": { "joins": ["O2", "A"], "length": 6 }, "3": { "joins": ["A", "B"], "length": 17 },
                   "4": { "joins": ["O4", "B", "D"], "sides": [11, 7, 13], "turn": "cw" },
                   "5": { "joins": ["D", "E"], "length": 19 }, "6": { "joins": ["O6", "E"], "length": 10 } },
        "near": { "B": [16, 9], "D": [22, 11], "E": [39, 14] },
        "input": { "link": 2, "angle": 70, "omega": "5 rad/s ccw" }, "find": asked
    });
    let (o2, o4, o6) = ([0.0; 2], [18.0, -2.0], [40.0, 3.0]);
    let a = times(unit(70_f64.to_radians()), 6.0);
    let b = meet(a, 17.0, o4, 11.0, [16.0, 9.0]);
    let d = meet(o4, 13.0, b, 7.0, [22.0, 11.0]);
    let e = meet(d, 19.0, o6, 10.0, [39.0, 14.0]);
    let i13 = crossing([o2, a], [o4, b]);
    let i15 = crossing([o4, d], [o6, e]);
    let va = times(left(a), 5.0);
    let arm = |at: Xy, from: Xy| minus(at, from);
    let rate = |v: Xy, arm: Xy| cross(arm, v) / dot(arm, arm);
    let over = match mistake {
        "AB" => 17.0 / long(arm(a, i13)),
        "the distance of B" => long(arm(b, i13)) / long(arm(a, i13)),
        _ => 1.0,
    };
    let w3 = rate(va, arm(a, i13)) / over;
    let vb = turned(w3, arm(b, i13));
    let w4 = rate(vb, arm(b, o4));
    let vd = times(turned(w4, arm(d, o4)), if mistake == "O4B for O4D" { 11.0 / 13.0 } else { 1.0 });
    let ve = turned(rate(vd, arm(d, i15)), arm(e, i15));
    let place = |at: Xy| json!({ "components": [four(at[0]), four(at[1])], "unit": "cm" });
    report(
        &scene,
        &handed_in(vec![
            ("I(1,3)", place(i13)),
            ("I(1,5)", place(i15)),
            ("v(B)", vector(vb, "cm/s")),
            ("omega(3)", turning(w3, "rad/s")),
            ("omega(4)", turning(w4, "rad/s")),
            ("v(E)", vector(ve, "cm/s")),
            ("omega(6)", turning(rate(ve, arm(e, o6)), "rad/s")),
        ]),
    )
}

#[test]
fn a_rate_over_another_arm_than_that_from_its_centre_is_named() {
    let right = centres("");
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    for (mistake, at, kind, how) in [
        ("AB", "omega(3)", Kind::WrongFormula, "over A to B"),
        ("the distance of B", "v(B)", Kind::WrongFormula, "over the distance of B"),
        ("O4B for O4D", "v(E)", Kind::TangentialWrongLength, "O4B"),
    ] {
        let told = centres(mistake);
        one_fault(&told, at, kind);
        assert!(named(&told, at).unwrap().1.contains(how), "{}", told.to_text());
    }
}

// --- forces --------------------------------------------------------------------------------------

/// An engine: crank 75 mm at 50°, 1200 rpm, rod 290 mm of 1.8 kg and 0.021 kg m² with its mass centre at 95 mm, piston of 1.2 kg under
/// 5200 N, above the crank.
fn engine(mistake: &str) -> Report {
    let scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 75 }, "3": { "joins": ["A", "B", "G3"], "line": [0, 290, 95] } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O", "angle": 90 } } ],
        "near": { "B": [0, 350] }, "input": { "link": 2, "angle": 50, "omega": "1200 rpm ccw" },
        "masses": { "3": { "mass": 1.8, "at": "G3", "inertia": 0.021 }, "4": { "mass": 1.2 } },
        "loads": [ { "name": "P", "on": 4, "at": "B", "force": 5200, "direction": -90 } ],
        "find": ["a(B)", "alpha(3)", "Fin(3)", "Fin(4)", "Tin(3)", "h(3)", "F(1,4)", "F(3,4)", "F(2,3)", "T(2)"]
    });
    let omega = 40.0 * PI;
    let a = times(unit(50_f64.to_radians()), 0.075);
    let rod = [-a[0], libm::sqrt(0.29 * 0.29 - a[0] * a[0])];
    let va = turned(omega, a);
    // V_B has no part across: V_A + ω₃ × d.
    let w3 = va[0] / rod[1];
    let known = plus(times(a, -omega * omega), times(rod, -w3 * w3));
    let e3 = known[0] / rod[1];
    let ab = [0.0, known[1] + e3 * rod[0]];
    let ag = plus(times(a, -omega * omega), times(minus(ab, times(a, -omega * omega)), 95.0 / 290.0));
    let (f3, f4) = (times(ag, -1.8), times(ab, -1.2));
    let t3 = -0.021 * e3 * if mistake == "kg mm²" { 1000.0 } else { 1.0 };
    let acts = if mistake == "left out" { [0.0; 2] } else { f3 };
    // F₃₄ = (x, −Σ on the piston); moments of the rod about A.
    let y = 5200.0 - f4[1];
    let to_mass = times(rod, 95.0 / 290.0);
    let x = (rod[0] * y - cross(to_mass, acts) - t3) / rod[1];
    let f34 = [x, y];
    let f23 = minus(f34, acts);
    let torque = cross(a, f23);
    report(
        &scene,
        &handed_in(vec![
            ("a(B)", vector(ab, "m/s^2")),
            ("alpha(3)", turning(e3, "rad/s^2")),
            ("Fin(3)", vector(f3, "N")),
            ("Fin(4)", vector(f4, "N")),
            ("Tin(3)", turning(t3, "N*m")),
            ("h(3)", json!(format!("{} mm", four((t3 / long(f3)).abs() * 1e3)))),
            ("F(1,4)", vector([-x, 0.0], "N")),
            ("F(3,4)", vector(f34, "N")),
            ("F(2,3)", vector(f23, "N")),
            ("T(2)", turning(torque, "N*m")),
        ]),
    )
}

/// Fⁱⁿ is handed in rightly and forgotten at its link, its torque is not; I is in another unit.
#[test]
fn a_name_does_not_contradict_what_was_handed_in() {
    let right = engine("");
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    let told = engine("left out");
    one_fault(&told, "F(1,4)", Kind::ForceLeftOut);
    let name = named(&told, "F(1,4)").unwrap().1;
    assert!(name.contains("left out at link 3, its couple kept"), "{}", told.to_text());
    one_fault(&engine("kg mm²"), "Tin(3)", Kind::MetreMixed);
}

/// A four-bar at rest under two loads, of which one is laid off by sine for cosine.
#[test]
fn sine_for_cosine_of_a_load_is_named() {
    let scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0], "O4": [300, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 120 },
                   "3": { "joins": ["A", "B", "C"], "shape": { "A": [0, 0], "B": [280, 0], "C": [150, 90] } },
                   "4": { "joins": ["O4", "B", "D"], "line": [0, 240, 150] } },
        "near": { "B": [330, 238] }, "input": { "link": 2, "angle": 60, "omega": "1 rad/s" },
        "loads": [ { "name": "P", "on": 3, "at": "C", "force": 400, "direction": -70 },
                   { "name": "Q", "on": 4, "at": "D", "force": "250 N", "direction": 200 } ],
        "find": ["F(3,4)", "F(1,4)", "F(2,3)", "T(2)"]
    });
    let a = times(unit(60_f64.to_radians()), 120.0);
    let b = meet(a, 280.0, [300.0, 0.0], 240.0, [330.0, 238.0]);
    let (three, rocker) = (minus(b, a), minus(b, [300.0, 0.0]));
    let along = times(three, 1.0 / 280.0);
    let c = plus(times(along, 150.0), times(left(along), 90.0));
    let q = times(unit(200_f64.to_radians()), 250.0);
    let check = |direction: f64| {
        let p = times(unit(direction.to_radians()), 400.0);
        // r₄ × F₃₄ = −(5/8 r₄) × Q and r₃ × F₃₄ = c × P.
        let moments = [-cross(times(rocker, 0.625), q), cross(c, p)];
        let det = cross(rocker, three);
        let f34 = [0, 1].map(|axis| (moments[0] * three[axis] - moments[1] * rocker[axis]) / det);
        let f23 = minus(f34, p);
        report(
            &scene,
            &handed_in(vec![
                ("F(3,4)", vector(f34, "N")),
                ("F(1,4)", vector(times(plus(f34, q), -1.0), "N")),
                ("F(2,3)", vector(f23, "N")),
                ("T(2)", turning(cross(a, f23) / 1000.0, "N*m")),
            ]),
        )
    };
    let right = check(-70.0);
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    one_fault(&check(-20.0), "F(3,4)", Kind::DirectionMeasured);
    assert!(!check(-20.0).to_text().contains("pressure"));
    one_fault(&check(70.0), "F(3,4)", Kind::DirectionMeasured);
}

/// A pump with rough pins and a rough guide: a journal of 70 mm diameter taken for one of 70 mm radius.
#[test]
fn the_diameter_of_a_journal_for_its_radius_is_named() {
    let scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 100 }, "3": { "joins": ["A", "B"], "length": 320 } },
        "slides": [ { "pin": "B", "block": 4, "f": 0.2, "on": { "link": 1, "through": "O", "angle": 0 } } ],
        "near": { "B": [-380, 0] }, "input": { "link": 2, "angle": 110, "omega": "8 rad/s ccw" },
        "pins": { "O": { "radius": 40, "f": 0.2 }, "A": { "diameter": 70, "f": 0.2 }, "B": { "radius": 25, "f": 0.2 } },
        "loads": [ { "name": "P", "on": 4, "at": "B", "force": 2000, "direction": 0 } ],
        "find": ["F(3,4)", "F(1,4)", "F(1,2)", "T(2)"]
    });
    let a = times(unit(110_f64.to_radians()), 100.0);
    let rod = [-libm::sqrt(320.0 * 320.0 - a[1] * a[1]), -a[1]];
    let w3 = -8.0 * a[0] / rod[0];
    let speed = -8.0 * a[1] - w3 * rod[1];
    let lean = libm::atan(0.2);
    let circle = libm::sin(lean);
    let check = |radius: f64| {
        // Of a force of 1 N: friction at both pins turns the rod against what it does beside crank and piston.
        let couple = -(w3 - 8.0).signum() * radius * circle - w3.signum() * 25.0 * circle;
        let moment = |angle: f64| couple - cross(rod, unit(angle));
        let mut angle = libm::atan2(rod[1], rod[0]);
        for _ in 0..60 {
            let slope = (moment(angle + 1e-6) - moment(angle)) / 1e-6;
            angle -= moment(angle) / slope;
        }
        // Along the guide: the rod, the load and what the guide rubs against the motion.
        let push = |angle: f64| {
            -2000.0 / (libm::cos(angle) - speed.signum() * libm::tan(lean) * libm::sin(angle).abs())
        };
        let mut force = push(angle);
        if force < 0.0 {
            angle += PI;
            for _ in 0..60 {
                let slope = (moment(angle + 1e-6) - moment(angle)) / 1e-6;
                angle -= moment(angle) / slope;
            }
            force = push(angle);
        }
        let f34 = times(unit(angle), force);
        let at_crank = -(w3 - 8.0).signum() * radius * circle * force;
        let at_pivot = -circle * 40.0 * force;
        let torque = -(cross(a, times(f34, -1.0)) - at_crank + at_pivot) / 1000.0;
        report(
            &scene,
            &handed_in(vec![
                ("F(3,4)", vector(f34, "N")),
                ("F(1,4)", vector(times(plus(f34, [2000.0, 0.0]), -1.0), "N")),
                ("F(1,2)", vector(f34, "N")),
                ("T(2)", turning(torque, "N*m")),
            ]),
        )
    };
    let right = check(35.0);
    assert_eq!(wrong(&right), [""; 0], "{}", right.to_text());
    let told = check(70.0);
    assert_eq!(wrong(&told).len(), 1, "{}", told.to_text());
    let at = wrong(&told)[0].to_owned();
    one_fault(&told, &at, Kind::DiameterForRadius);
}

/// A polygon that leaves the figure is drawn to its border, and that is said; indices in captions are lowered.
#[test]
fn a_polygon_that_leaves_the_overlay_is_drawn_to_its_border() {
    use linkgram::sheet::figure::{Node, Shape};
    let scene = slider();
    let overlay = |b: f64| {
        let answers = json!({ "points": { "velocity": { "o": [0, 0], "a": [-104, 60], "b": [b, 0] } },
                              "scales": { "velocity": "2.5 cm/s per mm" } });
        let answers = linkgram::grade::read_answers(&answers.to_string(), &scene).unwrap();
        let settings = linkgram::grade::GradeSettings::default();
        linkgram::grade::grade_with_overlay(&scene, &answers, &settings).unwrap().1.unwrap()
    };
    let longest = |figure: &linkgram::sheet::Figure| {
        let mut longest = 0.0_f64;
        figure.root.walk(&mut |node| {
            if let Node::Mark(mark) = node
                && let (Shape::Line(from, to), "student") = (&mark.shape, mark.class)
            {
                longest = longest.max(from.distance(*to));
            }
        });
        longest
    };
    let svg = |figure: &linkgram::sheet::Figure| {
        let options = linkgram::render::Options::default();
        let svg = linkgram::render::render(figure, linkgram::render::Format::Svg, &options).unwrap();
        String::from_utf8(svg).unwrap()
    };
    let said = "border";
    let near = overlay(-200.0);
    assert!((longest(&near) - 200.0).abs() < 1e-6 && !svg(&near).contains(said), "{}", longest(&near));
    let far = overlay(-19000.0);
    assert!((200.0..600.0).contains(&longest(&far)), "{}", longest(&far));
    assert!(svg(&far).contains(said), "{}", svg(&far));
}
