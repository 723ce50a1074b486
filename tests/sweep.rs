//! Sweeps: limits, change points, strokes and extremes against closed forms; every position against the
//! drawing of the same scene at that place; curves and samples within their tolerance.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod common;

use std::f64::consts::PI;

use linkgram::mechanism::quantity::Answer;
use linkgram::mechanism::{Given, Input, Mechanism, Place};
use linkgram::sweep::{EventKind, Sweep, SweepError};

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
/// the roundings of reckoning in metres instead of millimetres of paper.
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
        let mut next = values.iter();
        for (asked, reading) in scene.mechanism.asked.iter().zip(&drawn.solution.construction.answers) {
            let (value, bound) = match &reading.answer {
                Answer::Scalar { value, bound } => (vec![*value], *bound),
                Answer::Vector { value, bound } => (value.to_vec(), *bound),
                _ => continue,
            };
            for value in value {
                let Some(swept) = next.next().copied().flatten() else { continue };
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

#[test]
fn fitted_curves_stay_within_their_accuracy() {
    use kurbo::{ParamCurveNearest, Point, Vec2};
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["x(B)", "a(B)"]"#);
    let sweep = Sweep::new(&m, None).unwrap();
    let stretch = &sweep.stretches[0];
    // The hodograph of the acceleration, at 1 mm for 0.1 m/s².
    let track = |_: f64, values: &[Option<linkgram::board::Moving>]| {
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

#[test]
fn what_holds_at_one_instant_only_is_refused() {
    let m = four_bar(180.0, 60.0, 140.0, 120.0, r#"["omega(4)"]"#);
    assert!(matches!(Sweep::new(&m, Some([2.0, 1.0])), Err(SweepError::Range(_))));
    assert!(matches!(Sweep::new(&m, Some([1.0, 2.0])), Err(SweepError::Range(_))));
    let sweep = Sweep::new(&m, Some([0.5, 1.0])).unwrap();
    assert_eq!((sweep.stretches.len(), sweep.stretches[0].from, sweep.stretches[0].to), (1, 0.5, 1.0));
    let higher = common::example("pairs/higher-group").mechanism;
    assert!(matches!(Sweep::new(&higher, None), Err(SweepError::Draw(_))));
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
        let _ = linkgram::sheet::diagrams::of_sweep(&scene, &sweep);
    }
    assert!(swept > 20, "only {swept} examples can be swept");
}
