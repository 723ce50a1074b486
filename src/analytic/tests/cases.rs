//! Textbook problems, against values recomputed independently from their stated dimensions.

use super::bench::{Bench, both, near, number};
use crate::mechanism::quantity::{Answer, Quantity};
use crate::mechanism::{Form, Given, Input};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

fn problem_3_1() -> Bench {
    Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O4", 45.0, 15.0)
        .bar(2, "O2", "A", 15.0)
        .bar(3, "A", "B", 45.0)
        .link(4, &["O4", "B", "C"], Form::Line(vec![Given::exact(0.0), number(30.0), number(-30.0)]))
        .bar(5, "C", "D", 37.0)
        .near("B", 52.0, -14.0)
        .near("D", 1.0, 37.0)
        .pin_slides("D", Some(6), |b| b.straight(1, Err([0.0, 37.0]), 0.0))
        .drive(2, Some(30.0 * DEGREE), -10.0, 0.0)
        .journal("B", 0.5)
}

#[test]
fn problem_3_1_in_centimetres() {
    let s = problem_3_1().solve();
    both(s.at("B"), [52.496, -14.049], 6e-4);
    both(s.at("C"), [37.504, 44.049], 6e-4);
    both(s.at("D"), [1.182, 37.0], 6e-4);
    near(s.omega(3), 4.39703, 6e-6);
    near(s.omega(4), 5.84365, 6e-6);
    near(s.omega(5), -1.20591, 6e-6);
    near(s.omega(6), 0.0, 1e-13);
    near(s.alpha(3), 25.3088, 6e-5);
    near(s.alpha(4), -43.4273, 6e-5);
    near(s.alpha(5), -18.0658, 6e-5);
    both(s.v("D"), [-178.249, 0.0], 6e-4);
    both(s.a("D"), [1442.94, 0.0], 6e-3);
    let (a, b, c, d) = (s.p("A"), s.p("B"), s.p("C"), s.p("D"));
    near(s.length(Quantity::RelativeVelocity(b, a)), 197.866, 6e-4);
    near(s.length(Quantity::RelativeNormal(b, a)), 870.023, 6e-4);
    near(s.length(Quantity::RelativeTangential(b, a)), 1138.894, 6e-4);
    near(s.length(Quantity::Normal(b)), 1024.448, 6e-4);
    near(s.length(Quantity::Tangential(b)), 1302.819, 6e-4);
    near(s.length(Quantity::RelativeNormal(d, c)), 53.806, 6e-4);
    near(s.length(Quantity::RelativeTangential(d, c)), 668.434, 6e-4);
    near(s.scalar(Quantity::Rub(b, s.l(3), s.l(4))) * 10.0, 7.233, 6e-4);
    let (value, bound) = s.bounded(Quantity::Omega(s.l(4)));
    assert!(bound > 0.0 && bound < 1e-13 * value, "bound {bound:e}");
    let (value, bound) = s.bounded(Quantity::Alpha(s.l(5)));
    assert!(bound < 1e-12 * value.abs(), "bound {bound:e}");
    assert_eq!(s.state.singular_values().len(), 15);
}

#[test]
fn problem_3_2_whitworth_with_coriolis() {
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O4", 0.0, -12.0)
        .bar(2, "O2", "A", 20.0)
        .link(4, &["O4", "B"], Form::Line(vec![Given::exact(0.0), number(-20.0)]))
        .bar(5, "B", "C", 65.0)
        .near("B", 12.0, -28.0)
        .near("C", -51.0, -12.0)
        .pin_slides("A", Some(3), |b| b.straight(4, Ok("O4"), 0.0))
        .pin_slides("C", Some(6), |b| b.straight(1, Ok("O4"), 0.0))
        .drive(2, Some(150.0 * DEGREE), -1.5, 0.0)
        .solve();
    both(s.at("B"), [12.372, -27.714], 6e-4);
    both(s.at("C"), [-50.7, -12.0], 6e-4);
    near(s.omega(4), -0.995, 6e-4);
    near(s.omega(3), s.omega(4), 1e-14);
    near(s.omega(5), -0.195, 6e-4);
    near(s.alpha(4), 0.195, 6e-4);
    near(s.alpha(5), 0.275, 6e-4);
    let (a, link) = (s.p("A"), s.l(4));
    near(s.length(Quantity::Slip(a, link)), 11.135, 6e-4);
    near(s.length(Quantity::Coriolis(a, link)), 22.156, 6e-4);
    near(s.length(Quantity::SlipAcceleration(a, link)), 14.071, 6e-4);
    both(s.vector(Quantity::SlipNormal(a, link)), [0.0; 2], 0.0);
    near(s.length(Quantity::SlipTangential(a, link)), 14.071, 6e-4);
    both(s.v("C"), [-12.567, 0.0], 6e-4);
    both(s.a("C"), [-11.11, 0.0], 6e-3);
    near(s.length(Quantity::Acceleration(s.p("B"))), 20.176, 6e-4);
    // The block turns with its guide: its centre against the link is at infinity, square to the guide.
    match s.state.answer(&Quantity::Centre(s.l(3), s.l(4))) {
        Answer::AtInfinity { direction, .. } => {
            let along = [-17.320_508_075_688_775 / 28.0, 22.0 / 28.0];
            near(direction[0] * along[0] + direction[1] * along[1], 0.0, 1e-14);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn problem_3_3_curved_slot() {
    // C is where the recomputation puts it: 19 from B at 87.51°, so that VB3 is exactly 95.
    let (b, c) = ([1.740_66, -2.443_33], [2.566, 16.539]);
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O3", 14.0, 0.0)
        .placed("B", b[0], b[1])
        .placed("C", c[0], c[1])
        .link(2, &["O2", "B"], Form::Placed)
        .link(3, &["O3", "C"], Form::Placed)
        .pin_slides("B", None, |bench| bench.arc(3, "C", libm::hypot(c[0] - b[0], c[1] - b[1])))
        .drive(2, None, -50.0, 0.0)
        .solve();
    let (b, link) = (s.p("B"), s.l(3));
    near(s.omega(3), 7.6, 2e-3);
    near(s.length(Quantity::Slip(b, link)), 140.855, 0.05);
    near(s.length(Quantity::Coriolis(b, link)), 2140.989, 2.0);
    near(s.length(Quantity::SlipNormal(b, link)), 1044.211, 1.0);
    near(s.length(Quantity::SlipTangential(b, link)), 3640.613, 3.0);
    near(s.alpha(3), -563.207, 0.5);
    // The parts make the whole.
    let whole = s.vector(Quantity::SlipAcceleration(b, link));
    let (n, t) = (s.vector(Quantity::SlipNormal(b, link)), s.vector(Quantity::SlipTangential(b, link)));
    both([n[0] + t[0], n[1] + t[1]], whole, 1e-9);
}

fn problem_3_4(placed: bool) -> Bench {
    let (h, r) = (75.0 * (3.0_f64).sqrt() / 2.0, 75.0);
    let bench = Bench::new().fixed("O2", 0.0, 0.0).fixed("O3", -175.0, 0.0);
    let bench = if placed {
        bench.placed("C", -175.0 + r / 2.0, h).link(3, &["O3", "C"], Form::Placed)
    } else {
        bench.near("C", -137.0, 65.0).bar(3, "O3", "C", r)
    };
    bench
        .bar(2, "O2", "B", 50.0)
        .link(4, &["C", "E", "F"], Form::Line(vec![Given::exact(0.0), number(125.0), number(250.0)]))
        .link(6, &["D", "E", "G"], Form::Line(vec![Given::exact(0.0), number(100.0), number(200.0)]))
        .bar(7, "B", "D", 150.0)
        .near("F", -175.0, 312.0)
        .near("D", -56.0, 189.0)
        .pin_slides("F", Some(5), |b| b.straight(1, Ok("O3"), 90.0))
        .gears([2, 3], ["O2", "O3"], [75.0, 100.0], false)
        .drive(2, Some(90.0 * DEGREE), -100.0, 0.0)
}

#[test]
fn problem_3_4_gears() {
    let s = problem_3_4(true).solve();
    both(s.at("D"), [-56.25, 189.05], 6e-3);
    both(s.at("G"), [-256.25, 188.02], 6e-3);
    near(s.omega(3), 75.0, 1e-12);
    near(s.omega(4), -19.71, 6e-3);
    near(s.omega(6), -61.77, 6e-3);
    near(s.omega(7), 53.24, 6e-3);
    near(s.alpha(3), 0.0, 1e-10);
    near(s.alpha(4), -794.47, 6e-3);
    near(s.alpha(6), -7537.6, 6e-2);
    near(s.alpha(7), 4621.46, 6e-3);
    near(s.length(Quantity::Velocity(s.p("G"))), 9678.98, 6e-3);
    near(s.a("F")[1], -431_569.78, 6e-3);
    near(s.length(Quantity::Acceleration(s.p("D"))), 1_251_227.66, 6e-3);
    // The pitch point is the centre of the gears.
    both(s.vector(Quantity::Centre(s.l(2), s.l(3))), [-75.0, 0.0], 1e-12);
}

#[test]
fn a_gear_of_unknown_phase_is_not_determined() {
    let error = problem_3_4(false).try_solve().err();
    assert!(
        matches!(&error, Some(crate::analytic::AnalyticError::Underdetermined { links }) if links.contains(&3)),
        "{error:?}"
    );
}

#[test]
fn problem_9_1_is_exact_in_integers() {
    let s = Bench::new()
        .fixed("O", 0.0, 0.0)
        .fixed("C", 30.0, -5.0)
        .placed("A", 6.0, 25.0)
        .placed("B", 60.0, 55.0)
        .link(2, &["O", "A"], Form::Placed)
        .link(3, &["A", "B"], Form::Placed)
        .link(4, &["C", "B"], Form::Placed)
        .drive(2, None, 6.0, 0.0)
        .solve();
    near(s.omega(3), 1.0, 1e-13);
    near(s.omega(4), 3.0, 1e-13);
    near(s.alpha(3), 10.0, 1e-12);
    near(s.alpha(4), 5.0, 1e-12);
    both(s.v("A"), [-150.0, 36.0], 1e-12);
    both(s.v("B"), [-180.0, 90.0], 1e-12);
    both(s.a("A"), [-216.0, -900.0], 1e-12);
    both(s.a("B"), [-570.0, -390.0], 1e-11);
    both(s.vector(Quantity::RelativeNormal(s.p("B"), s.p("A"))), [-54.0, -30.0], 1e-12);
    both(s.vector(Quantity::Normal(s.p("B"))), [-270.0, -540.0], 1e-11);
    // Kennedy: I(1,3) is where O–A meets C–B.
    // O + s (6, 25) = C + t (30, 60), by Cramer's rule.
    let det = 6.0 * -60.0 + 30.0 * 25.0;
    let along = (30.0 * -60.0 - 30.0 * 5.0) / det;
    both(s.vector(Quantity::Centre(s.l(1), s.l(3))), [6.0 * along, 25.0 * along], 1e-11);
    for quantity in [Quantity::Omega(s.l(3)), Quantity::Omega(s.l(4)), Quantity::Alpha(s.l(4))] {
        let (value, bound) = s.bounded(quantity);
        let exact = value.round();
        assert!((value - exact).abs() <= bound && bound < 1e-11, "{quantity:?}: {value} ± {bound:e}");
    }
}

#[test]
fn problem_4_1_slider_crank() {
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .bar(2, "O2", "A", 50.8)
        .link(3, &["A", "B", "G3"], Form::Line(vec![Given::exact(0.0), number(203.2), number(50.8)]))
        .near("B", 245.0, 0.0)
        .pin_slides("B", Some(4), |b| b.straight(1, Ok("O2"), 0.0))
        .drive(2, Some(30.0 * DEGREE), 314.0, 0.0)
        .solve();
    near(s.scalar(Quantity::Angle(s.l(3))) / DEGREE, -7.1808, 6e-5);
    near(s.omega(3), -68.5204, 6e-5);
    near(s.alpha(3), 11830.41, 6e-3);
    both(s.a("G3"), [-4_499_156.0, -1_878_254.0], 0.6);
    both(s.at("G3"), [94.396, 19.05], 6e-4);
    both(s.v("B"), [-9716.0, 0.0], 0.6);
    both(s.a("B"), [-4_983_700.0, 0.0], 60.0);
}

#[test]
fn a_speed_drives_like_its_angular_velocity() {
    let with = |input: fn(&Bench) -> Input| {
        let bench = Bench::new()
            .fixed("O2", 0.0, 0.0)
            .fixed("O4", 4.0, 0.0)
            .bar(2, "O2", "A", 2.0)
            .bar(3, "A", "B", 4.0)
            .bar(4, "O4", "B", 3.0)
            .near("B", 4.0, 3.0);
        let input = input(&bench);
        bench.input(input).solve()
    };
    let by_speed = with(|b| Input::Speed {
        link: b.id(2),
        angle: Some(number(1.0)),
        point: b.clone().point("A"),
        speed: number(-6.0),
        alpha: number(0.5),
    });
    let by_rate = with(|b| Input::Angle {
        link: b.id(2),
        angle: Some(number(1.0)),
        omega: number(-3.0),
        alpha: number(0.5),
    });
    near(by_speed.omega(2), -3.0, 1e-14);
    for n in [2, 3, 4] {
        near(by_speed.omega(n), by_rate.omega(n), 1e-13);
        near(by_speed.alpha(n), by_rate.alpha(n), 1e-12);
    }
}
