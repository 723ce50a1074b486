//! Sweeps: limits, change points, strokes and extremes against closed forms; every position against the
//! drawing of the same scene at that place; curves and samples within their tolerance.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

use std::f64::consts::PI;

use linkgram::mechanism::quantity::{Answer, Quantity};
use linkgram::mechanism::{Given, Input, Mechanism, Place};
use linkgram::sweep::{EventKind, InputKind, Over, Sweep, SweepError};

fn four_bar(ground: f64, crank: f64, coupler: f64, rocker: f64, find: &str) -> Mechanism {
    let text = format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [{ground}, 0] }},
             "links": {{ "2": {{ "joins": ["O2", "A"], "length": {crank} }},
                        "3": {{ "joins": ["A", "B"], "length": {coupler} }},
                        "4": {{ "joins": ["O4", "B"], "length": {rocker} }} }},
             "near": {{ "B": [100, 1000] }}, "input": {{ "link": 2, "angle": 40, "omega": 10, "alpha": 3 }},
             "find": {find} }}"#
    );
    common::read(&text).mechanism
}

fn places(sweep: &Sweep, wanted: impl Fn(&EventKind) -> bool) -> Vec<f64> {
    sweep.events.iter().filter(|e| wanted(&e.kind)).map(|e| e.at).collect()
}

fn is_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{found} is not {expected}");
}

#[test]
fn a_crank_rocker_has_the_extremes_of_its_closed_form() {
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["omega(4)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    assert_eq!(sweep.stretches.len(), 1);
    assert!(places(&sweep, |k| matches!(k, EventKind::Limit | EventKind::ChangePoint)).is_empty());
    // Transmission angle: least and greatest with the crank along the frame, by the law of cosines.
    let column = sweep.columns.iter().position(|c| c.asked.name == "transmission(3/4)").unwrap();
    let mu = |distance: f64| {
        libm::acos((140.0 * 140.0 + 120.0 * 120.0 - distance * distance) / (2.0 * 140.0 * 120.0))
    };
    for event in &sweep.events {
        match event.kind {
            EventKind::Least { column: c, value } if c == column => is_near(value, mu(120.0)),
            EventKind::Greatest { column: c, value } if c == column => is_near(value, mu(240.0)),
            _ => {}
        }
    }
    // The rocker turns back where crank and coupler are in line: O2B = 140 ± 60.
    let stroke = sweep.strokes()[0];
    let at_frame =
        |reach: f64| libm::acos((180.0 * 180.0 + 120.0 * 120.0 - reach * reach) / (2.0 * 180.0 * 120.0));
    is_near(stroke.length, at_frame(200.0) - at_frame(80.0));
    let crank =
        |reach: f64| libm::acos((180.0 * 180.0 + reach * reach - 120.0 * 120.0) / (2.0 * 180.0 * reach));
    let (outer, inner) = (crank(200.0), PI + crank(80.0));
    is_near(stroke.ends[0].min(stroke.ends[1]), outer);
    is_near(stroke.ends[0].max(stroke.ends[1]), inner);
    let way = inner - outer;
    is_near(stroke.time_ratio, way.max(2.0 * PI - way) / way.min(2.0 * PI - way));
}

#[test]
fn an_offset_slider_crank_has_its_stroke_and_time_ratio() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 150 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 30], "angle": 0 } } ],
        "near": { "B": [200, 30] }, "input": { "link": 2, "angle": 30, "omega": 10 }, "find": ["v(B)"] }"#;
    let sweep = Sweep::new(&common::read(text).mechanism, None).unwrap();
    let stroke = sweep.strokes()[0];
    let reach = |l: f64| (l * l - 900.0_f64).sqrt();
    is_near(stroke.length, (reach(200.0) - reach(100.0)) / 1000.0);
    let (out, back) = (libm::asin(30.0 / 200.0), PI + libm::asin(30.0 / 100.0));
    is_near(stroke.ends[1], out);
    is_near(stroke.ends[0], back);
    is_near(stroke.time_ratio, (back - out) / (2.0 * PI - (back - out)));
}

/// A link that rides on a crank which rests at first: what turns with the crank does so a moment later, by the closed
/// form of its place.
#[test]
fn a_rider_turns_with_a_carrier_that_rests_at_the_start() {
    let text = r#"{ "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 3 },
                   "3": { "joins": ["C", "D"], "shape": { "C": [0, 0], "D": [0.5, 0.8] } } },
        "slides": [ { "link": 3, "on": { "link": 2, "through": "O", "toward": "A" } } ],
        "near": { "C": [1, 0.5], "D": [1, 1.5] },
        "inputs": [ { "link": 2, "angle": 30, "omega": 0, "alpha": 3 }, { "slide": 3, "at": 1.2, "velocity": 0.4 } ],
        "find": ["v(D)", "a(D)"] }"#;
    let sweep = Sweep::over(Over::Time, &common::read(text).mechanism, Some([0.0, 0.8])).unwrap();
    for t in [0.0, 0.3, 0.7] {
        let (sin, cos) = libm::sincos(PI / 6.0 + 1.5 * t * t);
        let ([x, y], w, e, s) = ([1.2 + 0.4 * t + 0.5, 0.8], 3.0 * t, 3.0, 0.4);
        // Along and across the crank.
        let v = [s - w * y, w * x];
        let a = [-e * y - w * w * x, e * x + 2.0 * w * s - w * w * y];
        let row = sweep.at(t).unwrap();
        for (column, found) in sweep.columns.iter().zip(&row) {
            let local = if column.asked.name == "v(D)" { v } else { a };
            let world = [cos * local[0] - sin * local[1], sin * local[0] + cos * local[1]];
            let Some(axis) = column.axis else { continue };
            let found = found.unwrap().value;
            assert!(
                (found - world[axis]).abs() < 1e-9,
                "{} at {t}: {found}, not {}",
                column.name(),
                world[axis]
            );
        }
    }
}

/// A column of a sweep at a place, SI units.
fn swept(sweep: &Sweep, name: &str, at: f64) -> Vec<f64> {
    let row = sweep.at(at).unwrap();
    let column = sweep.columns.iter().zip(&row).filter(|(column, _)| column.asked.name == name);
    column.map(|(_, found)| found.unwrap().value).collect()
}

/// A lever that lies on a rolling wheel, led by the wheel alone: what it turns by is no angle of the line to the wheel's
/// centre, for the wheel runs along it. φ of the lever is the angle of O1E less asin(r / O1E), and the wheel has turned by
/// that and by what it has rolled.
#[test]
fn a_wheel_that_leads_a_lever_turns_as_it_rolls() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O1": [0, 0], "Q": [100, -140] },
        "placed": { "B": [150, 0], "E": [60, 10], "F": [80, 10] },
        "links": { "2": { "joins": ["O1", "B"] }, "8": { "joins": ["Q", "E"] }, "5": { "joins": ["E", "F"] } },
        "rolls": [ { "links": [2, 5], "line": { "link": 2, "through": [0, 0], "angle": 0 }, "centre": "E",
                     "radius": 10 } ],
        "input": { "link": 8, "omega": 1 }, "find": ["angle(5)", "x(F)"] }"#;
    let start = libm::atan2(150.0, -40.0);
    let sweep = Sweep::new(&common::read(text).mechanism, Some([start - 0.3, start + 0.3])).unwrap();
    let (arm, r) = (libm::hypot(150.0, 40.0), 10.0);
    let lever = |[x, y]: [f64; 2]| {
        let far = libm::hypot(x, y);
        (libm::atan2(y, x) - libm::asin(r / far), (far * far - r * r).sqrt())
    };
    let began = lever([60.0, 10.0]);
    for by in [-0.25, -0.1, 0.0, 0.1, 0.25] {
        let (sin, cos) = libm::sincos(start + by);
        let centre = [100.0 + arm * cos, arm * sin - 140.0];
        let now = lever(centre);
        let turned = now.0 - began.0 - (now.1 - began.1) / r;
        let angle = swept(&sweep, "angle(5)", start + by)[0];
        is_near(angle, turned + 2.0 * PI * libm::round((angle - turned) / (2.0 * PI)));
        let (sin, cos) = libm::sincos(turned);
        let place = [centre[0] + 20.0 * cos, centre[1] + 20.0 * sin];
        for (found, place) in swept(&sweep, "x(F)", start + by).into_iter().zip(place) {
            is_near(found, place / 1000.0);
        }
    }
}

/// A wheel of one joint that carries a line on which another one rolls: the line turns with the wheel, and its angle is
/// asked for. F is 40 mm beside the wheel's axis and on the arc of its arm about O7.
#[test]
fn a_line_on_a_wheel_of_one_joint_turns_with_it() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [40, 0], "O7": [120, 0] },
        "placed": { "A": [0, 15], "F": [60, 40] },
        "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4"] }, "7": { "joins": ["O7", "F"] },
                   "8": { "joins": ["F"] } },
        "rolls": [ { "links": [2, 4], "centres": ["O2", "O4"], "radii": [20, 20] },
                   { "links": [4, 8], "line": { "link": 4, "through": "O4", "offset": 30 }, "centre": "F",
                     "radius": 10 } ],
        "input": { "link": 2, "omega": 1 }, "find": ["angle(4)", "x(F)"] }"#;
    let sweep = Sweep::new(&common::read(text).mechanism, Some([PI / 2.0 - 0.1, PI / 2.0 + 0.1])).unwrap();
    for by in [-0.09, -0.04, 0.0, 0.05, 0.08] {
        is_near(swept(&sweep, "angle(4)", PI / 2.0 + by)[0], -by);
        let (sin, cos) = libm::sincos(-by);
        let along = 80.0 * cos - (5200.0 - (40.0 + 80.0 * sin) * (40.0 + 80.0 * sin)).sqrt();
        let place = [40.0 + along * cos - 40.0 * sin, along * sin + 40.0 * cos];
        for (found, place) in swept(&sweep, "x(F)", PI / 2.0 + by).into_iter().zip(place) {
            is_near(found, place / 1000.0);
        }
    }
}

/// The stroke is found wherever in it the scene stands, at its very ends too, and over time as well.
#[test]
fn a_stroke_is_found_from_every_start() {
    for start in [0.0, 90.0, 179.0, 180.0, 270.0, 360.0, -180.0, 720.0] {
        let text = format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": 50 }},
                            "3": {{ "joins": ["A", "B"], "length": 150 }} }},
                 "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, 0], "angle": 0 }} }} ],
                 "near": {{ "B": [150, 0] }}, "input": {{ "link": 2, "angle": {start}, "omega": -2 }},
                 "find": ["v(B)"] }}"#
        );
        let m = common::read(&text).mechanism;
        for over in [Over::Input, Over::Time] {
            let sweep = Sweep::over(over, &m, None).unwrap();
            let strokes = sweep.strokes();
            assert_eq!(strokes.len(), 1, "{over:?} from {start}: {:?}", sweep.events);
            is_near(strokes[0].length, 0.1);
            is_near(strokes[0].time_ratio, 1.0);
        }
    }
}

#[test]
fn a_double_rocker_stops_at_its_limits() {
    // The crank goes until coupler and rocker are in line: O2... by the law of cosines on 60, 100, 70 + 50.
    let m = four_bar(100.0, 60.0, 70.0, 50.0, r#"["omega(4)", "x(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let limit = libm::acos((60.0 * 60.0 + 100.0 * 100.0 - 120.0 * 120.0) / (2.0 * 60.0 * 100.0));
    let found = places(&sweep, |k| matches!(k, EventKind::Limit));
    assert_eq!(found.len(), 2, "{:?}", sweep.events);
    assert!((found[0] - limit).abs() < 1e-12 && (found[1] - (2.0 * PI - limit)).abs() < 1e-12);
    assert!(sweep.at(limit + 1e-3).is_none(), "beyond the limit there is no position");
    assert!(sweep.stretches.iter().all(|s| !s.apart), "both sides are reached through 0 deg");
    let links = sweep.events.iter().find(|e| e.kind == EventKind::Limit).map(|e| sweep.links(e).to_vec());
    assert_eq!(links, Some(vec![3, 4]));
    // One answer for each place within, none without.
    let inside = sweep.positions(&sweep.equal_steps(360));
    let expected = (0..=360).filter(|i| {
        let at = f64::from(*i) * PI / 180.0;
        at <= limit || at >= 2.0 * PI - limit
    });
    assert_eq!(inside.len(), expected.count());
}

#[test]
fn a_parallelogram_goes_through_its_change_points() {
    let m = four_bar(100.0, 50.0, 100.0, 50.0, r#"["x(B)", "omega(3)", "omega(4)", "v(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let found = places(&sweep, |k| *k == EventKind::ChangePoint);
    assert_eq!(found.len(), 2);
    assert!(found[0].abs() < 1e-12 && (found[1] - PI).abs() < 1e-12);
    assert!(places(&sweep, |k| matches!(k, EventKind::Limit | EventKind::DeadPosition)).is_empty());
    // It stays a parallelogram all the way round: B is A moved by the frame.
    for position in sweep.positions(&sweep.equal_steps(720)) {
        let [x, y] = [0, 1].map(|c| position.values[c].unwrap());
        let (sin, cos) = libm::sincos(position.at);
        assert!(libm::hypot(x - 0.1 - 0.05 * cos, y - 0.05 * sin) < 1e-9, "at {}", position.at);
        let at_change_point = libm::sin(position.at).abs() < 1e-9;
        match (position.values[2], position.values[3]) {
            (None, None) => assert!(at_change_point, "indeterminate at {}", position.at),
            (Some(coupler), Some(rocker)) => {
                assert!(!at_change_point);
                assert!(coupler.abs() < 1e-6 && (rocker - 10.0).abs() < 1e-6, "at {}", position.at);
            }
            other => panic!("{other:?}"),
        }
    }
}

/// Every position of a sweep is the drawing of the scene at that place: within its bounds, and a few times
/// the roundings of computation in metres instead of millimetres of paper.
#[test]
fn positions_are_those_of_the_drawing() {
    for stem in ["s000-ch3a-1", "eight-link", "s000-ch4-7", "pairs/oblique-yoke"] {
        let scene = common::example(stem);
        let sweep = Sweep::new(&scene.mechanism, None).unwrap_or_else(|e| panic!("{stem}: {e}"));
        let Some(Input::Angle { angle: Some(start), .. }) = scene.mechanism.inputs.first().copied() else {
            panic!("{stem} has no angle");
        };
        // Beside the scene's own place the hints choose as the sweep goes on.
        let mut compared = 0;
        for step in -3..=3 {
            let turn = 2.0 * PI;
            let at = start.value + f64::from(step) * 0.02;
            let at = at - turn * (at / turn).floor();
            let mut turned = scene.clone();
            if let Input::Angle { angle, .. } = &mut turned.mechanism.inputs[0] {
                *angle = Some(Given::within(at, 4e-16 * at.abs()));
            }
            assert!(turned.mechanism.points.iter().all(|p| !matches!(p.place, Place::Placed(_))));
            let Ok(drawn) = common::try_draw(&turned, linkgram::plan::Extent::Asked) else { continue };
            let values = sweep.at(at).unwrap_or_else(|| panic!("{stem} is not reached at {at}"));
            let mut next = values.iter();
            for (asked, reading) in turned.mechanism.asked.iter().zip(&drawn.solution.construction.answers) {
                let (value, bound) = match &reading.answer {
                    Answer::Scalar { value, bound } => (vec![*value], *bound),
                    Answer::Vector { value, bound } => (value.to_vec(), *bound),
                    _ => continue,
                };
                for value in value {
                    let swept = next.next().unwrap().unwrap_or_else(|| panic!("{stem}: {}", asked.name));
                    let apart = (swept.value - value).abs();
                    assert!(apart <= bound + 8.0 * swept.error, "{stem}: {} at {at}: {apart:e}", asked.name);
                    compared += 1;
                }
            }
        }
        assert!(compared > 20, "{stem}: only {compared} numbers compared");
    }
}

/// At its own place every example that can be swept has the numbers of its drawing, placed links and all.
#[test]
fn every_example_begins_where_it_stands() {
    let mut compared = 0;
    for path in common::example_paths() {
        let scene = common::read(&std::fs::read_to_string(&path).unwrap());
        let Ok(sweep) = Sweep::new(&scene.mechanism, None) else { continue };
        let Ok(drawn) = common::try_draw(&scene, linkgram::plan::Extent::Asked) else { continue };
        let Some(values) = sweep.at(sweep.start) else {
            panic!("{}: its own place is not reached", path.display());
        };
        for (asked, reading) in scene.mechanism.asked.iter().zip(&drawn.solution.construction.answers) {
            let (value, bound) = match &reading.answer {
                Answer::Scalar { value, bound } => (vec![*value], *bound),
                Answer::Vector { value, bound } => (value.to_vec(), *bound),
                _ => continue,
            };
            let columns = sweep.columns.iter().zip(&values);
            let of_it: Vec<_> = columns.filter(|(c, _)| !c.watched && c.asked == *asked).collect();
            for (value, (_, swept)) in value.into_iter().zip(of_it) {
                let Some(swept) = swept else { continue };
                // What the sweep makes of placed points is rounded once more.
                let apart = (swept.value - value).abs();
                let name = format!("{}: {}", path.display(), asked.name);
                assert!(apart <= 1e3 * (bound + swept.error), "{name}: {apart:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "only {compared} numbers compared");
}

#[test]
fn derivatives_are_the_velocities() {
    // At ω = 1 and ε = 0 the derivative of a place by the angle is its velocity, that of ω the acceleration.
    let mut m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["x(B)", "v(B)", "omega(4)", "alpha(4)"]"#);
    if let Input::Angle { omega, alpha, .. } = &mut m.inputs[0] {
        (*omega, *alpha) = (Given::exact(1.0), Given::exact(0.0));
    }
    let sweep = Sweep::new(&m, None).unwrap();
    for i in 0..360 {
        let values = sweep.at(f64::from(i) * PI / 180.0).unwrap();
        let m = |c: usize| values[c].unwrap();
        assert!((m(0).slope - m(2).value).abs() < 1e-14 && (m(1).slope - m(3).value).abs() < 1e-14);
        assert!((m(4).slope - m(5).value).abs() < 1e-13);
    }
}

#[test]
fn blocks_and_single_looks_agree_and_every_call_order_gives_the_same() {
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["x(B)", "v(B)", "a(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let all = sweep.equal_steps(1000);
    let mut rows = Vec::new();
    sweep.run(&all, |at, values| rows.push((at, values.to_vec())));
    assert_eq!(rows.len(), 1001);
    for (at, values) in &rows {
        let looked = sweep.at(*at).unwrap();
        for (value, looked) in values.iter().zip(looked) {
            assert_eq!(*value, looked.unwrap().value);
        }
    }
    // A few of them alone: bit for bit the same.
    let few: Vec<f64> = all.iter().copied().step_by(37).collect();
    sweep.run(&few, |at, values| {
        assert!(rows.iter().any(|(a, v)| *a == at && v.as_slice() == values));
    });
}

#[test]
fn sampling_to_a_tolerance_holds_it() {
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["x(B)", "a(B)", "omega(4)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let tolerance = 1e-3;
    let coarse = sweep.adapted(1e-2).len();
    let places = sweep.adapted(tolerance);
    assert!(places.len() > coarse && places.len() < 400, "{} places", places.len());
    let value = |at: f64, c: usize| sweep.at(at).unwrap()[c].unwrap().value;
    for c in 0..5 {
        let all: Vec<f64> = (0..=720).map(|i| value(f64::from(i) * PI / 360.0, c)).collect();
        let range = all.iter().fold(f64::MIN, |a, b| a.max(*b)) - all.iter().fold(f64::MAX, |a, b| a.min(*b));
        for pair in places.windows(2) {
            for part in [0.25, 0.5, 0.75] {
                let at = pair[0] + (pair[1] - pair[0]) * part;
                let line = value(pair[0], c) + (value(pair[1], c) - value(pair[0], c)) * part;
                // The middle is what was looked at; beside it the curve may stray a little more.
                assert!((value(at, c) - line).abs() <= 1.3 * tolerance * range);
            }
        }
    }
}

/// Towards a limit a place goes as the root of what is left: sampled as well as anywhere else.
#[test]
fn sampling_holds_its_tolerance_at_a_limit() {
    let m = four_bar(100.0, 60.0, 70.0, 50.0, r#"["x(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let places = sweep.adapted(1e-4);
    assert!(places.len() < 2000, "{}", places.len());
    let limit = sweep.stretches[0].to;
    let y = |at: f64| sweep.at(at).unwrap()[1].unwrap().value;
    for pair in places.windows(2).filter(|p| p[0] < limit && p[1] <= limit) {
        let middle = f64::midpoint(pair[0], pair[1]);
        let line = f64::midpoint(y(pair[0]), y(pair[1]));
        assert!((y(middle) - line).abs() < 2e-4 * 0.1, "between {} and {}", pair[0], pair[1]);
    }
}

#[test]
fn fitted_curves_stay_within_their_accuracy() {
    use kurbo::{ParamCurveNearest, Point, Vec2};
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["x(B)", "a(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let stretch = &sweep.stretches[0];
    // The hodograph of the acceleration, at 1 mm for 0.1 m/s².
    let track = |_: f64, values: &[Option<linkgram::board::Dual>]| {
        let (x, y) = (values[2]?, values[3]?);
        Some((Point::new(10.0 * x.value, 10.0 * y.value), Vec2::new(10.0 * x.slope, 10.0 * y.slope)))
    };
    for accuracy in [0.1, 0.01, 0.001] {
        let path = sweep.curve(stretch, [stretch.from, stretch.to], &track, accuracy);
        for i in 1..400 {
            let at = stretch.from + (stretch.to - stretch.from) * f64::from(i) / 400.0;
            let (p, _) = track(at, &sweep.at(at).unwrap()).unwrap();
            let miss = path.segments().map(|s| s.nearest(p, 1e-9).distance_sq).fold(f64::INFINITY, f64::min);
            assert!(miss.sqrt() <= 2.0 * accuracy, "{} at {at}", miss.sqrt());
        }
    }
}

/// The speed of a rocker's pin has a corner where it turns back, its path a cusp: the curves go on behind them.
#[test]
fn curves_with_corners_are_followed_to_their_ends() {
    use kurbo::{ParamCurveNearest, Point, Vec2};
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["x(B)", "v(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let stretch = &sweep.stretches[0];
    let speed = |at: f64, values: &[Option<linkgram::board::Dual>]| {
        let (x, y) = (values[2]?, values[3]?);
        let length = libm::hypot(x.value, y.value);
        let change = (x.value * x.slope + y.value * y.slope) / length;
        Some((Point::new(10.0 * at, 50.0 * length), Vec2::new(10.0, 50.0 * change)))
    };
    let path = |_: f64, values: &[Option<linkgram::board::Dual>]| {
        let (x, y) = (values[0]?, values[1]?);
        Some((Point::new(300.0 * x.value, 300.0 * y.value), Vec2::new(300.0 * x.slope, 300.0 * y.slope)))
    };
    let tracks: [&linkgram::sweep::Track<'_>; 2] = [&speed, &path];
    for (index, track) in tracks.into_iter().enumerate() {
        let curve = sweep.curve(stretch, [stretch.from, stretch.to], track, 0.01);
        for i in 1..400 {
            let at = stretch.from + (stretch.to - stretch.from) * f64::from(i) / 400.0;
            let (p, _) = track(at, &sweep.at(at).unwrap()).unwrap();
            let miss = curve.segments().map(|s| s.nearest(p, 1e-9).distance_sq).fold(f64::INFINITY, f64::min);
            assert!(miss.sqrt() <= 0.02, "track {index}: {} at {at}", miss.sqrt());
        }
        // And nothing but the track: every point of the curve is near one of many places.
        let places: Vec<Point> = (0..=4000)
            .map(|i| stretch.from + (stretch.to - stretch.from) * f64::from(i) / 4000.0)
            .filter_map(|at| track(at, &sweep.at(at)?).map(|t| t.0))
            .collect();
        for segment in curve.segments() {
            for t in [0.25, 0.5, 0.75] {
                let p = kurbo::ParamCurve::eval(&segment, t);
                let miss = places.iter().map(|q| p.distance(*q)).fold(f64::INFINITY, f64::min);
                assert!(miss < 0.2, "track {index}: the curve strays to {p:?}");
            }
        }
    }
}

#[test]
fn what_holds_at_one_instant_only_is_refused() {
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["omega(4)"]"#);
    assert!(matches!(Sweep::new(&m, Some([2.0, 1.0])), Err(SweepError::Range(_))));
    assert!(matches!(Sweep::new(&m, Some([1.0, 2.0])), Err(SweepError::Range(_))));
    let sweep = Sweep::new(&m, Some([0.5, 1.0])).unwrap();
    assert_eq!((sweep.stretches.len(), sweep.stretches[0].from, sweep.stretches[0].to), (1, 0.5, 1.0));
}

/// The whole of every example either is swept or says why not; no number is infinite.
#[test]
fn every_example_is_swept_or_refused() {
    let mut swept = 0;
    for path in common::example_paths() {
        let scene = common::read(&std::fs::read_to_string(&path).unwrap());
        let Ok(sweep) = Sweep::new(&scene.mechanism, None) else { continue };
        swept += 1;
        for position in sweep.positions(&sweep.equal_steps(90)) {
            assert!(position.values.iter().flatten().all(|v| v.is_finite()), "{}", path.display());
        }
        for event in &sweep.events {
            assert!(event.at.is_finite(), "{}", path.display());
        }
        let _ = linkgram::sheet::diagrams::of_sweep(&scene, &sweep, linkgram::sheet::Language::English);
    }
    assert!(swept > 20, "only {swept} examples can be swept");
}

// --- over time ---------------------------------------------------------------------------------------------

/// The scene with every input where constant acceleration has brought it after `t` seconds, and with the rate that
/// it has then.
fn after(scene: &linkgram::scene::Scene, t: f64) -> linkgram::scene::Scene {
    let mut later = scene.clone();
    let close = |x: f64| Given::within(x, 4.0 * f64::EPSILON * x.abs().max(1.0));
    let moved = |place: Option<Given>, v: Given, a: Given| {
        let place = place.unwrap().value + v.value * t + a.value * t * t / 2.0;
        (Some(close(place)), close(v.value + a.value * t))
    };
    for input in &mut later.mechanism.inputs {
        match input {
            Input::Angle { angle, omega, alpha, .. } => (*angle, *omega) = moved(*angle, *omega, *alpha),
            Input::Slide { at, velocity, acceleration, .. } => {
                (*at, *velocity) = moved(*at, *velocity, *acceleration);
            }
            Input::Speed { .. } => panic!("the speed of a point is no law of motion"),
        }
    }
    later
}

const FIVE_BAR: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O5": [150, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "C"], "length": 120 },
               "4": { "joins": ["B", "C"], "length": 110 }, "5": { "joins": ["O5", "B"], "length": 50 } },
    "near": { "C": [80, 160] },
    "inputs": [ { "link": 2, "angle": 100, "omega": 3, "alpha": -2 },
                { "link": 5, "angle": 60, "omega": "2 rad/s cw", "alpha": 1 } ],
    "find": ["x(C)", "v(C)", "a(C)", "omega(3)", "alpha(4)", "angle(3)"] }"#;

const DRIVEN_SLIDE: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 150 } },
    "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 30], "angle": 0 } } ],
    "near": { "A": [20, 45] }, "input": { "slide": "B", "at": 150, "velocity": 40, "acceleration": -30 },
    "find": ["x(A)", "v(A)", "a(A)", "omega(2)", "alpha(2)"] }"#;

const SLOWING: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [180, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 140 },
               "4": { "joins": ["O4", "B"], "length": 120 } },
    "near": { "B": [100, 100] }, "input": { "link": 2, "angle": 40, "omega": "10 rad/s cw", "alpha": 3 },
    "find": ["x(B)", "v(B)", "a(B)", "omega(4)", "alpha(3)"] }"#;

/// Over time the position is that of the scene whose inputs have moved so far: by the independent solver.
#[test]
fn over_time_the_inputs_move_with_constant_acceleration() {
    for (text, span) in [(FIVE_BAR, [-0.1, 0.19]), (DRIVEN_SLIDE, [-0.2, 0.4]), (SLOWING, [0.0, 0.5])] {
        let scene = common::read(text);
        let sweep = Sweep::over(Over::Time, &scene.mechanism, Some(span)).unwrap();
        assert_eq!((sweep.input, sweep.start, sweep.stretches.len()), (InputKind::Time, 0.0, 1));
        for t in sweep.equal_steps(20) {
            let values = sweep.at(t).unwrap();
            let mut later = after(&scene, t);
            // The independent solver begins near the place that it should find.
            for (c, column) in sweep.columns.iter().enumerate() {
                if let (Quantity::Position(p), Some(0)) = (column.asked.quantity, column.axis) {
                    later.mechanism.points[p.0].place =
                        Place::Near([values[c].unwrap().value, values[c + 1].unwrap().value]);
                }
            }
            let state = linkgram::solve::solve_analytically(&later).unwrap();
            let mut next = values.iter().map(|v| v.unwrap());
            for asked in &scene.mechanism.asked {
                let (expected, bound) = match state.answer(&asked.quantity) {
                    Answer::Scalar { value, bound } => (vec![value], bound),
                    Answer::Vector { value, bound } => (value.to_vec(), bound),
                    other => panic!("{}: {other:?}", asked.name),
                };
                for expected in expected {
                    let swept = next.next().unwrap();
                    let apart = (swept.value - expected).abs();
                    assert!(
                        apart <= bound + swept.error,
                        "{} after {t} s: {apart:e} > {bound:e}",
                        asked.name
                    );
                }
            }
        }
    }
}

/// What changes in time changes at the rate that the polygons say.
#[test]
fn over_time_derivatives_are_velocities_and_accelerations() {
    for (text, span) in [(FIVE_BAR, [0.0, 0.19]), (DRIVEN_SLIDE, [0.0, 0.4]), (SLOWING, [0.0, 2.0])] {
        let scene = common::read(text);
        let sweep = Sweep::over(Over::Time, &scene.mechanism, Some(span)).unwrap();
        for position in sweep.equal_steps(100) {
            let values = sweep.at(position).unwrap();
            let m = |c: usize| values[c].unwrap();
            for c in 0..4 {
                let (slope, rate) = (m(c).slope, m(c + 2).value);
                assert!(
                    (slope - rate).abs() < 1e-12 * (1.0 + rate.abs()),
                    "{c} at {position}: {slope} {rate}"
                );
            }
        }
    }
}

#[test]
fn the_span_of_time_is_a_turn_of_the_input() {
    let with = |omega: f64, alpha: f64| {
        let mut m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["omega(4)"]"#);
        if let Input::Angle { omega: v, alpha: a, .. } = &mut m.inputs[0] {
            (*v, *a) = (Given::exact(omega), Given::exact(alpha));
        }
        m
    };
    let span = |omega, alpha| Sweep::over(Over::Time, &with(omega, alpha), None).unwrap().range[1];
    is_near(span(-10.0, 0.0), 0.2 * PI);
    // v t + a t²/2 = 2π.
    is_near(span(3.0, 2.0), (-3.0 + (9.0 + 8.0 * PI).sqrt()) / 2.0);
    is_near(span(0.0, 2.0), (2.0 * PI).sqrt());
    // It slows down, stops and turns back: −2π is reached first.
    is_near(span(2.0, -2.0), (2.0 + (4.0 + 8.0 * PI).sqrt()) / 2.0);
    is_near(span(-2.0, 2.0), (2.0 + (4.0 + 8.0 * PI).sqrt()) / 2.0);
    // A uniform turn has its stroke and its time ratio as over the angle.
    let by_time = Sweep::over(Over::Time, &with(-4.0, 0.0), None).unwrap();
    let by_angle = Sweep::new(&with(-4.0, 0.0), None).unwrap();
    let (t, a) = (by_time.strokes()[0], by_angle.strokes()[0]);
    is_near(t.length, a.length);
    is_near(t.time_ratio, a.time_ratio);
    assert!(matches!(Sweep::over(Over::Time, &with(0.0, 0.0), None), Err(SweepError::Instant(_))));
    let elsewhere = Sweep::over(Over::Time, &with(1.0, 0.0), Some([1.0, 2.0]));
    assert!(matches!(elsewhere, Err(SweepError::Range(_))));
}

/// Nothing moves on beyond a limit, in time; where nobody says how far to go, that is the end.
#[test]
fn a_range_that_nobody_stated_ends_where_the_mechanism_does() {
    let five = Sweep::over(Over::Time, &common::read(FIVE_BAR).mechanism, None).unwrap();
    assert_eq!(five.stretches.len(), 1);
    assert_eq!(places(&five, |k| matches!(k, EventKind::Limit)), [five.range[1]]);
    // There the couplers are in line: AB is as long as both.
    let (t, at) = (five.range[1], |r: f64, place: f64| [r * libm::cos(place), r * libm::sin(place)]);
    let a = at(60.0, 100.0 * PI / 180.0 + 3.0 * t - t * t);
    let b = at(50.0, 60.0 * PI / 180.0 - 2.0 * t + t * t / 2.0);
    is_near(libm::hypot(150.0 + b[0] - a[0], b[1] - a[1]), 230.0);
    // A slide goes as far as crank and rod reach from O2, 30 mm beside the guide.
    let slide = Sweep::new(&common::read(DRIVEN_SLIDE).mechanism, None).unwrap();
    let reach = |l: f64| (l * l - 900.0_f64).sqrt() / 1000.0;
    is_near(slide.range[0], reach(100.0));
    is_near(slide.range[1], reach(200.0));
    assert_eq!((slide.stretches.len(), slide.positions(&slide.equal_steps(10)).len()), (1, 11));
}

/// An input that is given by the speed of a pin turns on with the ω that this pin has now.
#[test]
fn the_speed_of_a_pin_is_a_law_of_motion_as_well() {
    let by = |input: &str| {
        common::read(&SLOWING.replace(r#""omega": "10 rad/s cw", "alpha": 3"#, input)).mechanism
    };
    let [speed, omega] = [r#""speed": { "A": "600 mm/s cw" }"#, r#""omega": "10 rad/s cw""#].map(by);
    let [speed, omega] = [speed, omega].map(|m| Sweep::over(Over::Time, &m, None).unwrap());
    is_near(speed.range[1], omega.range[1]);
    for t in omega.equal_steps(24) {
        let [a, b] = [&speed, &omega].map(|s| s.at(t).unwrap());
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a.value - b.value).abs() < 1e-12 * (1.0 + b.value.abs()), "{} {}", a.value, b.value);
        }
    }
}

// --- bounds ------------------------------------------------------------------------------------------------

/// Every number of every position lies within its bound of a drawing of 75 digits, and the bound is no larger than
/// it has to be: the tape's bound of the single drawing is of its size.
#[test]
fn every_position_is_within_its_bounds() {
    use linkgram::plan::{Extent, Plan};
    use linkgram::wide::Wide;
    let mut ratios = Vec::new();
    let mut to_tape = Vec::new();
    for stem in ["s000-ch3a-1", "eight-link", "s000-ch4-7", "pairs/oblique-yoke", "s000-ch4-1"] {
        let mut scene = common::example(stem);
        scene.mechanism.asked.retain(|a| !matches!(a.quantity, Quantity::Centre(..)));
        let sweep = Sweep::new(&scene.mechanism, None).unwrap_or_else(|e| panic!("{stem}: {e}"));
        let bounded = sweep.with_bounds().unwrap();
        let places: Vec<f64> = (-6..=6).map(|i| sweep.start + 0.004 * f64::from(i)).collect();
        bounded.run(&places, |at, values, bounds| {
            let mut turned = scene.clone();
            match &mut turned.mechanism.inputs[0] {
                Input::Angle { angle, .. } => *angle = Some(Given::exact(at)),
                Input::Slide { at: place, .. } => *place = Some(Given::exact(at)),
                Input::Speed { .. } => panic!("{stem}"),
            }
            let structure = linkgram::mechanism::structure::Structure::of(&turned.mechanism).unwrap();
            let plan = Plan::new(&turned.mechanism, &structure, Extent::Asked);
            let scales = common::scales_for(
                linkgram::graphical::extents(&turned.mechanism, &structure, &plan).unwrap(),
            );
            let truth = linkgram::graphical::recorded::<Wide>(&turned.mechanism, &structure, &plan, scales);
            let drawn = linkgram::graphical::recorded::<f64>(&turned.mechanism, &structure, &plan, scales);
            let mut next = values.iter().zip(bounds);
            for (truth, drawn) in truth.unwrap().iter().zip(drawn.unwrap()) {
                let (Some(truth), Some(drawn)) = (truth, drawn) else { continue };
                let mut together = 0.0;
                for truth in &truth.value {
                    let (value, bound) = next.next().unwrap();
                    let apart = (Wide::of(*value) - *truth).to_f64().abs();
                    assert!(apart <= *bound, "{stem} at {at}: {apart:e} > {bound:e}");
                    if apart > 0.0 {
                        ratios.push(bound / apart);
                    }
                    together = libm::hypot(together, *bound);
                }
                if let Some(bound) = drawn.bound.filter(|b| *b > 1e-18) {
                    to_tape.push(together / bound);
                }
            }
        });
    }
    for list in [&mut ratios, &mut to_tape] {
        list.sort_by(f64::total_cmp);
        assert!(list.len() > 500, "only {} numbers compared", list.len());
    }
    let middle = |list: &[f64]| list[list.len() / 2];
    let (ratio, tape) = (middle(&ratios), middle(&to_tape));
    assert!(ratio <= 100.0, "the median bound is {ratio} times the error");
    println!("bound/error {ratio}, to tape {tape} {} {}", to_tape[5], to_tape[to_tape.len() - 6]);
    assert!((0.25..4.0).contains(&tape), "the median bound is {tape} times that of the tape");
}

/// A Scotch yoke that is a link of one joint: it rides on the guide of the frame, and its slot stands square to that. With
/// a crank of 40 mm its place is 40 cos θ and its velocity −40 ω sin θ.
#[test]
fn a_yoke_of_one_joint_follows_the_cosine() {
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
             "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "4": { "joins": ["S"] } },
             "slides": [ { "link": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } },
                         { "pin": "A", "block": 3, "on": { "link": 4, "through": [0, 5], "angle": 90 } } ],
             "near": { "S": [20, 0] }, "input": { "link": 2, "angle": 60, "omega": 3 }, "find": ["x(S)", "v(S)"] }"#,
    );
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let mut looked = 0;
    sweep.run(&sweep.equal_steps(24), |at, values| {
        let expected = [0.04 * libm::cos(at), 0.0, -0.12 * libm::sin(at), 0.0];
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-15, "at {at}: {value} for {expected}");
        }
        looked += 1;
    });
    assert_eq!(looked, 25);
}

/// At the scene's own place a sweep computes the doubles of `solve`, and bounds them by the same rules. What is computed
/// twice stands once in a sweep and errs once, and what is constant errs as if it were independent: the bounds are not
/// the same, but of one size. (Centres are left out: which of them a drawing goes over is chosen by the eye.)
#[test]
fn the_drawing_and_its_sweep_are_one() {
    use linkgram::mechanism::quantity::{Answer, Method};
    use linkgram::plan::Extent;
    let (mut scenes, mut ratios) = (0, Vec::new());
    let (mut apart, mut numbers, mut tried) = (Vec::new(), 0, Vec::new());
    for (name, mut scene) in common::scenes() {
        scene.mechanism.asked.retain(|asked| asked.method == Method::default() && !asked.by_centres());
        scene.mechanism.asked.retain(|asked| !matches!(asked.quantity, Quantity::Centre(..)));
        let Ok(sweep) = Sweep::new(&scene.mechanism, None) else { continue };
        if sweep.tries() {
            tried.push(format!("{name}: "));
        }
        let Ok(bounded) = sweep.with_bounds() else { continue };
        // A sweep begins within the turn from zero on.
        let given = match &mut scene.mechanism.inputs[0] {
            Input::Angle { angle: Some(at), .. } | Input::Slide { at: Some(at), .. } => {
                *at = Given::within(sweep.start, at.error);
                *at
            }
            _ => continue,
        };
        let Ok(solved) = linkgram::solve::solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene)
        else {
            continue;
        };
        scenes += 1;
        bounded.run_within(
            &[sweep.start],
            |_| given.error,
            |_, values, bounds| {
                let readings = scene.mechanism.asked.iter().zip(&solved.solution.construction.answers);
                for (asked, reading) in readings {
                    let (value, bound) = match &reading.answer {
                        Answer::Scalar { value, bound } => (vec![*value], *bound),
                        Answer::Vector { value, bound } => (value.to_vec(), *bound),
                        _ => continue,
                    };
                    let what = format!("{name}: {}", asked.name);
                    let of_it = sweep.columns.iter().filter(|c| !c.watched).enumerate();
                    let columns = of_it.filter(|(_, c)| c.asked.name == asked.name).map(|(index, _)| index);
                    let columns: Vec<usize> = columns.collect();
                    if columns.len() != value.len() {
                        continue;
                    }
                    let mut together = 0.0;
                    for (&column, value) in columns.iter().zip(&value) {
                        numbers += 1;
                        assert!(
                            (values[column].abs() - value.abs()).abs() <= bound + bounds[column],
                            "{what}"
                        );
                        // A magnitude is given with either sign.
                        if values[column] != *value && values[column] != value.abs() {
                            apart.push(format!(
                                "{what} is {} in the sweep, {value} in the drawing",
                                values[column]
                            ));
                        }
                        together = libm::hypot(together, bounds[column]);
                    }
                    if bound > 0.0 {
                        ratios.push((together / bound, what));
                    }
                }
            },
        );
    }
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(scenes > 60 && ratios.len() > 500, "only {scenes} scenes, {} quantities", ratios.len());
    assert!(apart.is_empty(), "{} of {numbers}\n{}", apart.len(), apart.join("\n"));
    let (least, most) = (&ratios[0], &ratios[ratios.len() - 1]);
    println!(
        "{scenes} scenes, {} bounds: {least:?} to {most:?}, {:?}",
        ratios.len(),
        ratios[ratios.len() / 2]
    );
    // Rates that are found by trial are quotients of small differences, whose errors a sweep tightens by sweeps of their own.
    let by_trial = |what: &str| tried.iter().any(|name| what.starts_with(name.as_str()));
    let least = ratios.iter().find(|(_, what)| !by_trial(what)).unwrap_or(least);
    assert!(ratios[0].0 > 1.0 / 3.0 && least.0 > 0.4 && most.0 < 2.5, "{least:?} {most:?}");
}

/// Two lengths that are equal by chance are not one number: each may be off on its own. (x of B over each of four
/// lengths by the closed form of the parallelogram: the coupler turns by what the sides differ.)
#[test]
fn equal_numbers_of_a_scene_err_independently() {
    let m = four_bar(100.0, 50.0, 100.0, 50.0, r#"["x(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    sweep.with_bounds().unwrap().run(&[sweep.start], |at, values, bounds| {
        // ∂x_B/∂r₄ = 1 / tan θ · …: move one side alone by half a unit in its last place.
        for side in 0..2 {
            let mut other = [100.0, 50.0, 100.0, 50.0];
            let nudge = 1e-9;
            other[1 + 2 * side] += 1000.0 * nudge;
            let moved = four_bar(other[0], other[1], other[2], other[3], r#"["x(B)"]"#);
            let moved = Sweep::new(&moved, None).unwrap().at(at).unwrap()[0].unwrap().value;
            let by = ((moved - values[0]) / nudge).abs() * 0.05 * f64::EPSILON / 2.0;
            assert!(bounds[0] > by, "side {side}: {:e} {by:e}", bounds[0]);
        }
    });
}

/// At a change point nothing is determined; beside it bounds grow, until a number is no longer one.
#[test]
fn bounds_end_where_numbers_do() {
    let m = four_bar(100.0, 50.0, 100.0, 50.0, r#"["x(B)", "omega(3)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let bounded = sweep.with_bounds().unwrap();
    let places: Vec<f64> = (0..16).rev().map(|i| PI - libm::exp2(-4.0 * f64::from(i))).rev().collect();
    let mut ascending = places.clone();
    ascending.sort_by(f64::total_cmp);
    let mut last = 0.0;
    bounded.run(&ascending, |at, values, bounds| {
        assert!(bounds[2] >= last, "at {at}: {} after {last}", bounds[2]);
        last = bounds[2];
        // ω₃ of a parallelogram is zero.
        assert!(values[2].abs() <= bounds[2] || !bounds[2].is_finite(), "at {at}");
    });
    assert!(!last.is_finite(), "next to the change point ω₃ is refused");
}

// --- rolling wheels ----------------------------------------------------------------------------------------

/// The place of a point, in millimetres.
fn place_of(sweep: &Sweep, at: f64, name: &str) -> [f64; 2] {
    let column = sweep.columns.iter().position(|c| c.asked.name == format!("x({name})")).unwrap();
    let values = sweep.at(at).unwrap_or_else(|| panic!("not reached at {at}"));
    [0, 1].map(|axis| 1000.0 * values[column + axis].unwrap_or_else(|| panic!("{name} at {at}")).value)
}

/// The pin of a planet in a fixed ring draws a hypotrochoid; over three turns, for 50 : 20 closes only after two.
#[test]
fn a_planet_carries_its_pin_along_a_hypotrochoid() {
    let scene = common::read(&common::example_text("pairs/planet-and-rod").replace("\"v(B)\"", "\"x(B)\""));
    let sweep = Sweep::new(&scene.mechanism, Some([-2.0 * PI, 6.0 * PI])).unwrap();
    assert!(sweep.stretches.iter().all(|s| !s.apart));
    for i in 0..=400 {
        let at = -2.0 * PI + 8.0 * PI * f64::from(i) / 400.0;
        // The planet turns by 1 − 50/20 of what its arm turns.
        let (arm, own) = (libm::sincos(at), libm::sincos(PI / 2.0 + at * (1.0 - 2.5)));
        let expected = [30.0 * arm.1 + 15.0 * own.1, 30.0 * arm.0 + 15.0 * own.0];
        let found = place_of(&sweep, at, "B");
        assert!(
            libm::hypot(found[0] - expected[0], found[1] - expected[1]) < 1e-10,
            "{found:?} {expected:?}"
        );
    }
}

/// A rim point of a wheel on a plane: turned by the way of the centre over the radius; its velocity is the
/// derivative of its place.
#[test]
fn a_wheel_on_a_plane_turns_by_the_way_of_its_centre() {
    let centre = |at: f64| {
        let (sin, cos) = libm::sincos(at);
        40.0 * cos + (120.0_f64 * 120.0 - (5.0 - 40.0 * sin) * (5.0 - 40.0 * sin)).sqrt()
    };
    let start = 70.0_f64.to_radians();
    let c = centre(start);
    let text = common::example_text("pairs/wheel-on-plane")
        .replace(r#""joins": ["C"]"#, r#""joins": ["C", "R"]"#)
        .replace(r#""near": { "C": [140, 5] }"#, &format!(r#""placed": {{ "C": [{c}, 5], "R": [{c}, 30] }}"#))
        .replace(r#""x(C)""#, r#""x(R)", "v(R)""#)
        .replace(r#""omega": "10 rad/s ccw", "alpha": 4"#, r#""omega": 1"#);
    let sweep = Sweep::new(&common::read(&text).mechanism, None).unwrap();
    let column = sweep.columns.iter().position(|c| c.asked.name == "x(R)").unwrap();
    for i in 0..=180 {
        let at = 2.0 * PI * f64::from(i) / 180.0;
        let (sin, cos) = libm::sincos(PI / 2.0 - (centre(at) - c) / 25.0);
        let found = place_of(&sweep, at, "R");
        let expected = [centre(at) + 25.0 * cos, 5.0 + 25.0 * sin];
        assert!(libm::hypot(found[0] - expected[0], found[1] - expected[1]) < 1e-9, "{found:?} {expected:?}");
        let values = sweep.at(at).unwrap();
        for axis in 0..2 {
            let (slope, rate) =
                (values[column + axis].unwrap().slope, values[column + 2 + axis].unwrap().value);
            assert!((slope - rate).abs() < 1e-12, "at {at}: {slope} {rate}");
        }
    }
}

/// A gear on a fixed pivot carries its pin by the ratio of the radii: problem 3-4, whose chain closes in one place
/// only; its gear 3 stands at 120° there.
#[test]
fn a_gear_carries_its_pin_by_the_ratio() {
    let text = common::example_text("s000-ch3a-4").replace(r#""v(B)","#, r#""x(C)", "x(P3)","#);
    let sweep = Sweep::new(&common::read(&text).mechanism, None).unwrap();
    let mut compared = 0;
    for i in 0..=720 {
        let at = 2.0 * PI * f64::from(i) / 720.0;
        if sweep.at(at).is_none() {
            continue;
        }
        let turned = -0.75 * (at - PI / 2.0);
        let own = PI / 3.0 + turned;
        let expected = [-175.0 + 75.0 * libm::cos(own), 75.0 * libm::sin(own)];
        let found = place_of(&sweep, at, "C");
        assert!(libm::hypot(found[0] - expected[0], found[1] - expected[1]) < 1e-9, "{found:?} {expected:?}");
        let own = own - PI / 3.0;
        let expected = [-175.0 + 100.0 * libm::cos(own), 100.0 * libm::sin(own)];
        let found = place_of(&sweep, at, "P3");
        assert!(libm::hypot(found[0] - expected[0], found[1] - expected[1]) < 1e-9, "{found:?} {expected:?}");
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
    assert!(matches!(sweep.with_bounds(), Err(SweepError::Instant(_))));
}

// --- instant centres ---------------------------------------------------------------------------------------

/// The centre of the coupler lies on both cranks' lines, at the distance V / ω; where the coupler does not turn it is
/// at infinity.
#[test]
fn a_centre_goes_through_infinity_where_its_link_does_not_turn() {
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["I(1,3)", "x(A)", "x(B)", "omega(3)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let infinite = places(&sweep, |k| matches!(k, EventKind::AtInfinity { .. }));
    let mut turns_back = 0;
    let mut last: Option<f64> = None;
    for i in 0..=1440 {
        let values = sweep.at(f64::from(i) * PI / 720.0).unwrap();
        let value = |c: usize| values[c].unwrap().value;
        let omega = value(6);
        turns_back += usize::from(last.is_some_and(|last| (last < 0.0) != (omega < 0.0)));
        last = Some(omega);
        let [p, a, b] = [[value(0), value(1)], [value(2), value(3)], [value(4) - 0.18, value(5)]];
        let q = [p[0] - 0.18, p[1]];
        let size = libm::hypot(p[0], p[1]) + 0.1;
        assert!((p[0] * a[1] - p[1] * a[0]).abs() < 1e-11 * size * size, "on O2A: {p:?}");
        assert!((q[0] * b[1] - q[1] * b[0]).abs() < 1e-11 * size * size, "on O4B: {p:?}");
        let away = libm::hypot(p[0] - a[0], p[1] - a[1]);
        assert!((omega.abs() * away - 0.6).abs() < 1e-9 * size, "V = ω PA: {} {away}", omega.abs() * away);
    }
    assert_eq!((infinite.len(), turns_back), (2, 2));
    for at in infinite {
        let omega = sweep.at(at).unwrap()[6].unwrap();
        assert!(omega.value.abs() < 1e-12, "the coupler turns with {} there", omega.value);
    }
}

/// Whitworth's quick return and the crank-shaper, by the geometry that every textbook has of them.
#[test]
fn quick_returns_have_the_time_ratios_of_the_textbook() {
    let stroke = |kind: &str, name: &str| {
        let kind = linkgram::catalogue::KINDS.iter().find(|k| k.name == kind).unwrap();
        let sweep = Sweep::new(&common::read(kind.scene).mechanism, None).unwrap();
        let strokes = sweep.strokes();
        let stroke = strokes.iter().find(|s| sweep.columns[s.column].asked.name.starts_with(name));
        *stroke.unwrap_or_else(|| panic!("{}: {strokes:?}", kind.name))
    };
    // Crank 80, offset 40: the arm is along the guide where cos (α/2) = 40/80; the ram goes twice the arm of 60.
    let whitworth = stroke("whitworth", "x(C)");
    is_near(whitworth.length, 0.12);
    is_near(whitworth.time_ratio, 2.0);
    // Crank 50, pivots 120 apart: the lever of 220 swings by φ to either side, sin φ = 50/120.
    let swing = libm::asin(50.0 / 120.0);
    let shaper = stroke("crank-shaper", "x(D)");
    is_near(shaper.length, 2.0 * 0.22 * libm::sin(swing));
    is_near(shaper.time_ratio, (PI + 2.0 * swing) / (PI - 2.0 * swing));
    let lever = stroke("crank-shaper", "angle(4)");
    is_near(lever.length, 2.0 * swing);
    is_near(lever.time_ratio, shaper.time_ratio);
}

/// A slider-crank in centimetres: crank 10, rod 30, guide at this height.
fn slider_crank(height: f64, start: f64, find: &str) -> Mechanism {
    let text = format!(
        r#"{{ "units": {{ "length": "cm" }}, "fixed": {{ "O2": [0, 0] }},
             "links": {{ "2": {{ "joins": ["O2", "A"], "length": 10 }},
                        "3": {{ "joins": ["A", "B"], "length": 30 }} }},
             "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, {height}], "angle": 0 }} }} ],
             "near": {{ "B": [30, {height}] }}, "input": {{ "link": 2, "angle": {start}, "omega": 10 }},
             "find": {find} }}"#
    );
    common::read(&text).mechanism
}

/// The rod's pole lies on the crank's line and square above the slider: at x_B tan θ, and at infinity where the crank
/// stands upright. A centre's two columns are one thing, whichever of them depends on the divisor and whatever stands next.
#[test]
fn the_pole_of_a_connecting_rod_is_where_its_two_lines_meet() {
    for height in [0.0, 5.0] {
        for start in [30.0, 33.3, 90.0, 270.0, 0.0] {
            for find in [r#"["I(1,3)"]"#, r#"["x(B)", "I(1,3)"]"#, r#"["I(1,3)", "I(2,4)", "x(B)"]"#] {
                let m = slider_crank(height, start, find);
                let sweep = Sweep::new(&m, None).unwrap();
                let of = |name: &str| {
                    let centre = sweep.centres.iter().find(|c| c.asked.name == name);
                    centre.unwrap_or_else(|| panic!("no {name} from {start}")).columns
                };
                let case = format!("height {height}, from {start}, {find}");
                let infinite: Vec<(f64, f64)> = sweep
                    .events
                    .iter()
                    .filter_map(|e| match e.kind {
                        EventKind::AtInfinity { centre, direction } => {
                            assert_eq!(sweep.centres[centre].asked.name, "I(1,3)", "{case}");
                            Some((e.at, direction))
                        }
                        _ => None,
                    })
                    .collect();
                assert_eq!(infinite.len(), 2, "{case}: {:?}", sweep.events);
                for ((at, direction), expected) in infinite.into_iter().zip([PI / 2.0, 1.5 * PI]) {
                    is_near(at, expected);
                    is_near(direction, PI / 2.0);
                    for column in of("I(1,3)") {
                        assert!(
                            sweep.at(expected).unwrap()[column].is_none(),
                            "{case}: a number at infinity"
                        );
                    }
                }
                for i in 0..36 {
                    let at = f64::from(i) * PI / 18.0;
                    let values = sweep.at(at).unwrap();
                    let Some([x, y]) = of("I(1,3)")
                        .map(|c| values[c])
                        .into_iter()
                        .collect::<Option<Vec<_>>>()
                        .map(|v| [v[0], v[1]])
                    else {
                        assert!(i == 9 || i == 27, "{case}: no pole at {at}");
                        continue;
                    };
                    assert!(i != 9 && i != 27, "{case}: a number at infinity");
                    let (sin, cos) = libm::sincos(at);
                    let rise = height / 100.0 - 0.1 * sin;
                    let slider = 0.1 * cos + (0.09 - rise * rise).sqrt();
                    is_near(x.value, slider);
                    is_near(y.value, slider * sin / cos);
                }
            }
        }
    }
}

/// Beyond some ten groups a running bound takes a healthy chain for noise: the numbers of its last links were lost, and
/// the walk searched for touches of arcs where there were none.
#[test]
fn a_long_chain_is_swept_to_its_end_with_work_in_proportion() {
    let work = |dyads: usize| {
        let mut fixed = String::from(r#""O0": [0, 0], "O1": [20, 0]"#);
        let mut links = String::from(
            r#""2": { "joins": ["O0", "A0"], "length": 5 }, "3": { "joins": ["A0", "A1"], "length": 18 },
               "4": { "joins": ["O1", "A1"], "length": 12 }"#,
        );
        let mut near = String::from(r#""A1": [18, 12]"#);
        for i in 2..=dyads {
            use std::fmt::Write as _;
            let rod = 20.0 + 0.3 * (((i * 7) % 5) as f64 - 2.0);
            let rocker = 12.0 + 0.1 * ((i * 3) % 4) as f64;
            write!(fixed, r#", "O{i}": [{}, 0]"#, 20 * i).unwrap();
            let (before, first) = (i - 1, 2 * i + 1);
            write!(links, r#", "{first}": {{ "joins": ["A{before}", "A{i}"], "length": {rod} }}, "{}": {{ "joins": ["O{i}", "A{i}"], "length": {rocker} }}"#, first + 1)
                .unwrap();
            write!(near, r#", "A{i}": [{}, 12]"#, 20 * i - 2).unwrap();
        }
        let last = 2 * dyads + 2;
        let text = format!(
            r#"{{ "units": {{ "length": "cm" }}, "fixed": {{ {fixed} }}, "links": {{ {links} }}, "near": {{ {near} }},
                 "input": {{ "link": 2, "angle": 40, "omega": 10 }}, "find": ["omega({last})", "x(A{dyads})"] }}"#
        );
        let scene = common::read(&text);
        let sweep = Sweep::new(&scene.mechanism, None).unwrap();
        assert!(
            places(&sweep, |k| !matches!(k, EventKind::Least { .. } | EventKind::Greatest { .. })).is_empty()
        );
        assert_eq!(sweep.strokes().len(), dyads, "every rocker swings");
        // The other solver says the same of the scene's own place.
        let Ok(state) = linkgram::solve::solve_analytically(&scene) else { panic!("the chain stands") };
        let here = sweep.at(sweep.start).unwrap();
        for (index, asked) in scene.mechanism.asked.iter().enumerate() {
            let numbers: Vec<f64> = match state.answer(&asked.quantity) {
                Answer::Scalar { value, .. } => vec![value],
                Answer::Vector { value, .. } => value.to_vec(),
                other => panic!("{other:?}"),
            };
            for (axis, number) in numbers.into_iter().enumerate() {
                let swept = here[index + axis].unwrap();
                assert!(
                    (swept.value - number).abs() <= 8.0 * swept.error + 1e-12,
                    "{}: {swept:?} {number}",
                    asked.name
                );
            }
        }
        let events = sweep.events.len() as u64;
        assert!(sweep.looked() <= 1500 + 40 * events, "{dyads}: {} looks, {events} events", sweep.looked());
        sweep.looked() * sweep.operations() as u64
    };
    let (short, long) = (work(6), work(24));
    assert!(long < 20 * short, "{short} {long}");
}

/// Whatever is swept, and whatever of it is drawn, takes no more looks than are stated.
#[test]
fn every_sweep_stays_within_its_stated_work() {
    let mut scenes: Vec<(String, String)> = common::example_paths()
        .into_iter()
        .map(|path| (path.display().to_string(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    scenes
        .extend(linkgram::catalogue::KINDS.iter().map(|kind| (kind.name.to_owned(), kind.scene.to_owned())));
    let mut swept = 0;
    for (name, text) in scenes {
        let plain = common::read(&text).mechanism;
        // As it stands, and asked for all its centres.
        let mut centres = plain.clone();
        let unit = plain.asked.first().map(|a| a.unit.clone()).unwrap();
        centres.asked.clear();
        for i in 0..plain.links.len() {
            for j in i + 1..plain.links.len() {
                let (i, j) = (linkgram::mechanism::LinkId(i), linkgram::mechanism::LinkId(j));
                centres.asked.push(linkgram::mechanism::quantity::Asked {
                    name: format!("I({},{})", plain.link(i).number, plain.link(j).number),
                    quantity: Quantity::Centre(i, j),
                    unit: unit.clone(),
                    method: linkgram::mechanism::quantity::Method::Polygon,
                });
            }
        }
        for (kind, m) in [("asked", plain), ("centres", centres)] {
            let Ok(sweep) = Sweep::new(&m, None) else { continue };
            swept += 1;
            let (events, turns) = (sweep.events.len() as u64, u64::from(sweep.looks() / 720));
            let looked = sweep.looked();
            assert!(looked <= 3000 * turns + 60 * events, "{name}, {kind}: {looked} looks, {events} events");
            let places = sweep.adapted(1e-2).len();
            assert!(places <= 4000 * sweep.stretches.len(), "{name}, {kind}: {places} places");
            let drawn = if kind == "asked" { 2 } else { 0 };
            for stretch in sweep.stretches.iter().take(drawn) {
                let table = sweep.table(stretch).len();
                assert!(table <= 6500, "{name}, {kind}: {table} places of the table");
            }
        }
    }
    assert!(swept > 200, "{swept}");
}

/// A wheel on the ground whose centre a crank and a rod lead: it may roll above the line or hang below it. With a crank of
/// 10 and a rod of 15 the track below, 10 lower, is out of reach from 30° to 150°; that limits nobody who rolls above.
#[test]
fn a_track_that_nobody_took_limits_nobody() {
    let text = r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "G": [0, -5] },
        "links": { "2": { "joins": ["O2", "A"], "length": 10 }, "3": { "joins": ["A", "C"], "length": 15 },
                   "4": { "joins": ["C"] } },
        "rolls": [ { "links": [1, 4], "line": { "link": 1, "through": "G", "angle": 0 }, "centre": "C", "radius": 5 } ],
        "near": { "C": [20, 0] }, "input": { "link": 2, "angle": 10, "omega": 10 }, "find": ["x(C)", "omega(4)"] }"#;
    let sweep = Sweep::new(&common::read(text).mechanism, None).unwrap();
    let stopped = places(&sweep, |k| !matches!(k, EventKind::Least { .. } | EventKind::Greatest { .. }));
    assert!(stopped.is_empty(), "{:?}", sweep.events);
    for i in 0..72 {
        let at = f64::from(i) * PI / 36.0;
        let (sin, cos) = libm::sincos(at);
        let values = sweep.at(at).unwrap();
        is_near(values[0].unwrap().value, 0.1 * cos + (0.0225 - 0.01 * sin * sin).sqrt());
    }
}

/// The magnitude of a vector is least and greatest where its closed form says so, through zero as well.
#[test]
fn magnitudes_have_extremes() {
    let m = slider_crank(0.0, 20.0, r#"["v(B)", "v(A)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let speed = |at: f64| {
        let (sin, cos) = libm::sincos(at);
        1.0 * (sin + 0.1 * sin * cos / (0.09 - 0.01 * sin * sin).sqrt())
    };
    let (mut least, mut greatest) = (Vec::new(), Vec::new());
    for event in &sweep.events {
        match event.kind {
            EventKind::Least { column: 0, value } => least.push((event.at, value)),
            EventKind::Greatest { column: 0, value } => greatest.push((event.at, value)),
            // The crank's pin has one speed all the way round.
            EventKind::Least { column, .. } | EventKind::Greatest { column, .. } => assert!(column >= 4),
            _ => panic!("{event:?}"),
        }
    }
    assert_eq!(sweep.name_of_extreme(0), "|v(B)|");
    // It stands still at both dead points.
    assert_eq!(least.len(), 2, "{least:?}");
    for (at, value) in least {
        assert!(libm::sin(at).abs() < 1e-12 && value == 0.0, "{at} {value}");
    }
    assert_eq!(greatest.len(), 2, "{greatest:?}");
    for (at, value) in greatest {
        is_near(value, speed(at).abs());
        for beside in [-1e-3, 1e-3] {
            assert!(speed(at + beside).abs() < value);
        }
    }
}

/// A size whose slope leaps where it is zero has its least there: of a centric slider-crank at constant speed the rod's
/// inclination is odd about both dead points, so that it has no angular acceleration there, and its inertia force passes
/// through its mass centre.
#[test]
fn a_distance_that_falls_to_zero_has_its_least_there() {
    let text = r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 10 }, "3": { "joins": ["A", "G", "B"], "line": [0, 12, 30] } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } } ],
        "near": { "B": [30, 0] }, "input": { "link": 2, "angle": 20, "omega": 10 },
        "masses": { "3": { "mass": 2, "at": "G", "inertia": 0.02 } }, "find": ["h(3)"] }"#;
    let sweep = Sweep::new(&common::read(text).mechanism, None).unwrap();
    let least = |event: &&linkgram::sweep::Event| matches!(event.kind, EventKind::Least { value: 0.0, .. });
    let least: Vec<f64> = sweep.events.iter().filter(least).map(|event| event.at).collect();
    assert_eq!(least.len(), 2, "{:?}", sweep.events);
    for at in least {
        assert!(libm::sin(at).abs() < 1e-9, "{at}");
    }
}

// --- the sweep checks itself ---------------------------------------------------------------------------------

/// The independent solver confirms every example and every kind of the catalogue; a number under a wrong name is found.
#[test]
fn every_sweep_is_confirmed_and_a_wrong_one_is_not() {
    let mut scenes: Vec<(String, String)> = common::example_paths()
        .into_iter()
        .map(|path| (path.display().to_string(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    scenes
        .extend(linkgram::catalogue::KINDS.iter().map(|kind| (kind.name.to_owned(), kind.scene.to_owned())));
    let (mut swept, mut compared, mut found) = (0, 0, 0);
    for (name, text) in scenes {
        let Ok(mut sweep) = Sweep::new(&common::read(&text).mechanism, None) else { continue };
        swept += 1;
        match linkgram::check::confirm_sweep(&sweep) {
            Ok(positions) => compared += positions,
            Err(why) => panic!("{name}: {why:?}"),
        }
        if swept % 4 != 0 {
            continue;
        }
        // One moving point under the name of another.
        let moving = |q: Quantity| matches!(q, Quantity::Velocity(_));
        let columns: Vec<usize> =
            (0..sweep.columns.len()).filter(|&c| moving(sweep.columns[c].asked.quantity)).collect();
        let of = |c: usize| sweep.columns[c].asked.quantity;
        if let [first, .., last] = columns[..]
            && of(first) != of(last)
        {
            sweep.columns[first].asked.quantity = of(last);
            found += usize::from(linkgram::check::confirm_sweep(&sweep).is_err());
        }
    }
    assert!(swept > 100 && compared > 8 * swept / 2, "{swept} {compared}");
    assert!(found > 10, "{found}");
}

/// A radius of curvature has no sign, on whichever side of its point the path bends.
#[test]
fn a_radius_of_curvature_is_never_negative() {
    let m = slider_crank(5.0, 20.0, r#"["rho(A)", "v(A)", "a(A)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    for i in 0..72 {
        let values = sweep.at(f64::from(i) * PI / 36.0).unwrap();
        is_near(values[0].unwrap().value, 0.1);
    }
    let mut coupler = common::example("constructions/inflection").mechanism;
    coupler.asked.retain(|asked| matches!(asked.quantity, Quantity::PathRadius(_)));
    let sweep = Sweep::new(&coupler, None).unwrap();
    let all = sweep.positions(&sweep.equal_steps(360));
    assert!(all.iter().flat_map(|p| &p.values).flatten().all(|radius| *radius >= 0.0));
}

/// A parallelogram from where all its links lie in line: the row of that end is there, with the places that are known, as it is
/// in a whole turn.
#[test]
fn a_change_point_at_an_end_of_the_range_has_its_row() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 100 },
                   "4": { "joins": ["O4", "B"], "length": 40 } },
        "near": { "B": [140, 0.0007] }, "input": { "link": 2, "angle": 0.001, "omega": 5 },
        "find": ["x(B)", "omega(4)"] }"#;
    let scene = linkgram::scene::read(text, "parallelogram.json").unwrap();
    let sweep = Sweep::new(&scene.mechanism, Some([0.0, std::f64::consts::FRAC_PI_2])).unwrap();
    let mut rows = Vec::new();
    sweep.each_position(&sweep.equal_steps(3), |at, values| rows.push((at, values.to_vec())));
    assert_eq!(rows.len(), 4, "{rows:?}");
    let (at, values) = &rows[0];
    assert!(*at == 0.0 && values[2].is_none(), "{rows:?}");
    let (Some(x), Some(y)) = (values[0], values[1]) else { panic!("{rows:?}") };
    assert!((x - 0.14).abs() < 1e-9 && y.abs() < 1e-9, "{x} {y}");
}
