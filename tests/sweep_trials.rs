//! Groups of higher class over the range of the input: what the drawing found by trial is found again for every place.

use std::f64::consts::TAU;

use linkgram::check::confirm_sweep;
use linkgram::mechanism::quantity::{Answer, Order};
use linkgram::sweep::{EventKind, Over, Sweep};

use crate::common;

/// Stephenson's six-bar driven where no dyad is solvable alone.
const STEPHENSON: &str = r#"{ "units": { "length": "mm" },
  "fixed": { "O2": [0, 0], "O6": [170, 0], "O5": [150, 130] },
  "links": { "2": { "joins": ["O2", "A"], "length": 35 }, "3": { "joins": ["A", "B"], "length": 90 },
    "4": { "joins": ["B", "C", "D"], "sides": [80, 70, 60], "turn": "cw" },
    "5": { "joins": ["O5", "C"], "length": 60 }, "6": { "joins": ["O6", "D"], "length": 80 } },
  "near": { "B": [95, 75], "C": [165, 75], "D": [140, 30] },
  "input": { "link": 2, "angle": 70, "omega": "1 rad/s ccw" },
  "find": ["omega(4)", "alpha(4)"] }"#;

type Place = [f64; 2];

/// Where two circles meet, on the left of the way from the first centre to the second, or on the right.
fn meet([p, q]: [Place; 2], [r, s]: [f64; 2], left: bool) -> Option<Place> {
    let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
    let d = libm::hypot(dx, dy);
    let along = (d * d + r * r - s * s) / (2.0 * d);
    let across = (r * r - along * along).sqrt() * if left { 1.0 } else { -1.0 };
    let at = [p[0] + (along * dx - across * dy) / d, p[1] + (along * dy + across * dx) / d];
    at[0].is_finite().then_some(at)
}

/// The same mechanism driven from link 5, where it is two dyads: D in millimetres, the angle of link 4 and that of link 2.
fn from_the_other_side(of_link_5: f64) -> Option<(Place, f64, f64)> {
    in_assembly(of_link_5, [false, true])
}

/// The same with D and A on the left of the ways from C to O6 and from O2 to B, or on the right.
fn in_assembly(of_link_5: f64, [left, over]: [bool; 2]) -> Option<(Place, f64, f64)> {
    let (sin, cos) = libm::sincos(of_link_5);
    let c = [150.0 + 60.0 * cos, 130.0 + 60.0 * sin];
    let d = meet([c, [170.0, 0.0]], [70.0, 80.0], left)?;
    let b = meet([c, d], [80.0, 60.0], false)?;
    let a = meet([[0.0, 0.0], b], [35.0, 90.0], over)?;
    Some((d, libm::atan2(d[1] - c[1], d[0] - c[0]), libm::atan2(a[1], a[0])))
}

/// The difference of two angles within half a turn.
fn turned(to: f64, from: f64) -> f64 {
    let apart = to - from;
    apart - TAU * (apart / TAU).round()
}

fn limits_of(sweep: &Sweep) -> Vec<f64> {
    sweep.events.iter().filter(|e| e.kind == EventKind::Limit).map(|e| e.at).collect()
}

#[test]
fn a_group_of_higher_class_moves_as_it_does_from_its_other_side() {
    let scene = common::read(STEPHENSON);
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let limits = limits_of(&sweep);
    let of_link_6 = sweep.columns.iter().position(|column| column.name() == "angle(6)").unwrap();
    // Link 5 turned through all places in which the chain closes as in the scene: link 2 goes to and fro between limits.
    let mut compared = 0;
    for step in 0..7200 {
        const BY: f64 = 1e-5;
        let at = TAU * f64::from(step) / 7200.0;
        let [Some(before), Some(here), Some(after)] = [at - BY, at, at + BY].map(from_the_other_side) else {
            continue;
        };
        // Differences tell nothing where this side comes to its own end.
        if [-0.02, 0.02].iter().any(|by| from_the_other_side(at + by).is_none()) {
            continue;
        }
        let rate = turned(after.2, before.2) / (2.0 * BY);
        let input = here.2.rem_euclid(TAU);
        let Some(values) = sweep.at(input) else { continue };
        // Next to a limit both assemblies of an input are near each other.
        if limits.iter().any(|limit| turned(input, *limit).abs() < 0.05) {
            continue;
        }
        let [omega, alpha, angle] = [0, 1, of_link_6].map(|column: usize| values[column].unwrap().value);
        let off = turned(angle, libm::atan2(here.0[1], here.0[0] - 170.0));
        if off.abs() > 0.01 {
            // The other assembly of the same input.
            continue;
        }
        assert!(off.abs() < 1e-9, "{at}: {angle} {:?}", here.0);
        if rate.abs() > 0.5 {
            let expected = turned(after.1, before.1) / (2.0 * BY) / rate;
            assert!((omega - expected).abs() < 1e-6 * (1.0 + expected.abs()), "{at}: ω₄ {omega} {expected}");
            // ε at ω = 1: the derivative of ω₄ by the input.
            let by = 1e-6;
            let near = [input - by, input + by].map(|at| sweep.at(at).and_then(|all| all[0]));
            if let [Some(a), Some(b)] = near {
                let expected = (b.value - a.value) / (2.0 * by);
                assert!((alpha - expected).abs() < 1e-6 * (1.0 + alpha.abs()), "{at}: α₄ {alpha} {expected}");
            }
        }
        compared += 1;
    }
    assert!(compared > 1000, "{compared}");
    assert!(confirm_sweep(&sweep).is_ok());
}

/// The input turns round where it is extreme over the angle of link 5.
#[test]
fn a_group_of_higher_class_ends_where_its_input_turns_round() {
    let scene = common::read(STEPHENSON);
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let limits = limits_of(&sweep);
    assert_eq!(limits.len(), 2, "{limits:?}");
    assert!(!sweep.events.iter().any(|e| e.kind == EventKind::DeadPosition));
    for limit in limits {
        assert_eq!(sweep.links(sweep.events.iter().find(|e| e.at == limit).unwrap()), [3, 4, 5]);
        let mut nearest = f64::INFINITY;
        for assembly in [[false, true], [false, false], [true, true], [true, false]] {
            let off = |at: f64| in_assembly(at, assembly).map(|found| turned(found.2, limit));
            for step in 0..720 {
                let ends = [step, step + 1].map(|step| TAU * f64::from(step) / 720.0);
                // The extreme, if there is one between, by thirds.
                for sign in [1.0, -1.0] {
                    let [mut low, mut high] = ends;
                    for _ in 0..80 {
                        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
                        let [Some(fa), Some(fb)] = [a, b].map(off) else { break };
                        if sign * fa > sign * fb { high = b } else { low = a }
                    }
                    if let (true, Some(off)) = (low > ends[0] && high < ends[1], off(low)) {
                        nearest = f64::min(nearest, off.abs());
                    }
                }
            }
        }
        assert!(nearest < 1e-12, "{limit}: {nearest:e}");
    }
}

/// Numbers of every place are within their bounds of those of the drawing of that place, and of the equations.
#[test]
fn bounds_hold_where_something_is_found_by_trial() {
    let scene = common::read(STEPHENSON);
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let bounded = sweep.with_bounds().unwrap();
    let places: Vec<f64> =
        sweep.equal_steps(97).into_iter().filter(|at| sweep.stretch_at(*at).is_some()).collect();
    let mut compared = 0;
    bounded.run(&places, |at, values, bounds| {
        let mechanism = sweep.mechanism_at(at).unwrap();
        let state = linkgram::analytic::solve(&mechanism, Order::Acceleration).unwrap();
        let truth = mechanism.asked.iter().flat_map(|asked| match state.answer(&asked.quantity) {
            Answer::Scalar { value, bound } => vec![(value, bound)],
            Answer::Vector { value, bound } => value.map(|x| (x, bound)).to_vec(),
            other => panic!("{other:?}"),
        });
        for ((value, bound), (truth, of_truth)) in values.iter().zip(bounds).zip(truth) {
            assert!((value - truth).abs() <= bound + of_truth, "{at}: {value} {truth} {bound:e}");
            assert!(*bound < 1e-9 * (1.0 + value.abs()), "{at}: {bound:e}");
            compared += 1;
        }
    });
    assert!(compared > 100, "{compared}");
}

/// Over time as over the input: with constant ω the same places.
#[test]
fn time_leads_a_group_of_higher_class_to_the_same_places() {
    let scene = common::read(STEPHENSON);
    let over_input = Sweep::new(&scene.mechanism, None).unwrap();
    let over_time = Sweep::over(Over::Time, &scene.mechanism, Some([0.0, 1.5])).unwrap();
    for step in 1..15 {
        let t = 0.1 * f64::from(step);
        let [there, then] = [over_input.at((70.0_f64.to_radians() + t).rem_euclid(TAU)), over_time.at(t)];
        for (a, b) in there.unwrap().iter().zip(then.unwrap()).take(2) {
            let (a, b) = (a.unwrap().value, b.unwrap().value);
            assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{t}: {a} {b}");
        }
    }
}

/// A four-bar driven by its coupler: the trial turns the crank, which goes to and fro and is at a dead centre of its own on the
/// way. By the closed form of the crank's angle the coupler turns from the least angle of one assembly, through where
/// both meet, to the greatest of the other.
#[test]
fn a_dead_centre_of_a_trial_limits_nobody() {
    const LINKS: [f64; 3] = [43.0, 91.0, 105.0];
    const PIVOT: Place = [189.0, 27.0];
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [189, 27] },
             "links": { "2": { "joins": ["O2", "A"], "length": 43 }, "3": { "joins": ["A", "B"], "length": 91 },
                        "4": { "joins": ["O4", "B"], "length": 105 } },
             "near": { "A": [29.6, 30.9], "B": [102, 86.6] }, "input": { "link": 3, "angle": 37.5, "omega": 1 },
             "find": ["omega(2)"] }"#,
    );
    let coupler = |crank: f64, left: bool| {
        let (sin, cos) = libm::sincos(crank);
        let a = [LINKS[0] * cos, LINKS[0] * sin];
        let b = meet([a, PIVOT], [LINKS[1], LINKS[2]], left)?;
        Some(libm::atan2(b[1] - a[1], b[0] - a[0]))
    };
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let (mut least, mut greatest, mut compared) = (f64::INFINITY, f64::NEG_INFINITY, 0);
    for left in [true, false] {
        for step in 0..40_000 {
            const BY: f64 = 1e-5;
            let at = TAU * f64::from(step) / 40_000.0;
            let [Some(before), Some(here), Some(after)] = [at - BY, at, at + BY].map(|at| coupler(at, left))
            else {
                continue;
            };
            (least, greatest) = (least.min(here), greatest.max(here));
            let rate = turned(after, before) / (2.0 * BY);
            if step % 97 != 0 || rate.abs() < 0.3 || rate.abs() > 3.0 {
                continue;
            }
            let omega = sweep.at(here.rem_euclid(TAU)).unwrap_or_else(|| panic!("{here} is not reached"))[0];
            let omega = omega.unwrap().value;
            // One input may belong to two places of the crank; only one of them is reached.
            if (omega - 1.0 / rate).abs() < 1e-5 {
                compared += 1;
            }
        }
    }
    let limits = limits_of(&sweep);
    assert_eq!(limits.len(), 2, "{limits:?}");
    assert!(sweep.stretches.windows(2).all(|pair| sweep.is_one_assembly(&pair[0], &pair[1])));
    for end in [least, greatest] {
        let nearest = limits.iter().map(|limit| turned(*limit, end).abs()).fold(f64::INFINITY, f64::min);
        // The extreme of a scan is off by the square of its step.
        assert!(nearest < 1e-8, "{end}: {limits:?}");
    }
    assert!(compared > 60, "{compared}");
    assert!(confirm_sweep(&sweep).is_ok());
}
