//! Laws that hold for every mechanism: velocities are derivatives of places, wheels obey Willis, units and
//! far origins change nothing, bounds cover what the given numbers leave open, and what cannot be known is
//! refused.

use proptest::prelude::*;

use super::bench::{Bench, Solution, both, near, number};
use crate::analytic::{AnalyticError, State};
use crate::mechanism::quantity::{Answer, Indeterminate, Quantity};
use crate::mechanism::{Form, Given, Input, Mechanism, Place, Sense};

const QUARTER: f64 = std::f64::consts::FRAC_PI_2;

/// Velocities and accelerations of every point and link against differences of positions.
///
/// `at(t)` is the mechanism at time t; its hints must hold for |t| ≤ 2e-3.
fn check_by_differences(at: impl Fn(f64) -> Bench, points: &[&str], links: &[u32]) {
    let now = at(0.0).solve();
    let h = 1e-3;
    let around: Vec<Solution> = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * h).solve()).into();
    // Five-point formulas: errors of h⁴.
    let first = |f: [f64; 4]| (f[0] - 8.0 * f[1] + 8.0 * f[2] - f[3]) / (12.0 * h);
    let second =
        |f: [f64; 4], f0: f64| (-f[0] + 16.0 * f[1] - 30.0 * f0 + 16.0 * f[2] - f[3]) / (12.0 * h * h);
    let tolerance = |x: f64| 1e-5 * (1.0 + x.abs());
    for name in points {
        let place = now.at(name);
        let (v, a) = (now.v(name), now.a(name));
        for axis in [0, 1] {
            let f = [0, 1, 2, 3].map(|k| around[k].at(name)[axis]);
            near(v[axis], first(f), tolerance(v[axis]));
            near(a[axis], second(f, place[axis]), tolerance(a[axis]));
        }
    }
    for n in links {
        let angle = |s: &Solution| s.scalar(Quantity::Angle(s.l(*n)));
        let here = angle(&now);
        let f = [0, 1, 2, 3].map(|k| {
            let d = angle(&around[k]) - here;
            here + d - (d / std::f64::consts::TAU).round() * std::f64::consts::TAU
        });
        near(now.omega(*n), first(f), tolerance(now.omega(*n)));
        near(now.alpha(*n), second(f, here), tolerance(now.alpha(*n)));
    }
}

/// θ, ω, α of a crank at time t.
fn crank(theta: f64, omega: f64, alpha: f64) -> impl Fn(f64) -> (f64, f64, f64) {
    move |t| (theta + omega * t + alpha * t * t / 2.0, omega + alpha * t, alpha)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn six_bar_with_a_slider(
        theta in 0.0..6.2, omega in -3.0..3.0, alpha in -3.0..3.0, r in 0.4..1.2, l in 3.0..4.0, side in 0..2,
    ) {
        let motion = crank(theta, omega, alpha);
        let up = if side == 0 { 1.0 } else { -1.0 };
        let at = |t: f64| {
            let (angle, omega, alpha) = motion(t);
            Bench::new()
                .fixed("O2", 0.0, 0.0)
                .fixed("O4", 4.0, 0.5)
                .bar(2, "O2", "A", r)
                .link(3, &["A", "B", "P"], Form::Sides {
                    first_second: number(l), second_third: number(2.0), third_first: number(2.5), turn: Sense::Ccw,
                })
                .bar(4, "O4", "B", 2.5)
                .bar(5, "P", "D", 8.0)
                .near("B", 4.0, 3.0 * up)
                .near("D", 12.0, 0.0)
                .pin_slides("D", Some(6), |b| b.straight(1, Ok("O4"), 10.0))
                .drive(2, Some(angle), omega, alpha)
        };
        check_by_differences(at, &["A", "B", "P", "D"], &[2, 3, 4, 5, 6]);
    }

    #[test]
    fn slotted_links(
        theta in 0.0..6.2, omega in -3.0..3.0, alpha in -3.0..3.0, r in 0.4..1.5, tilt in -20.0..20.0,
        block in any::<bool>(), offset in -0.3..0.3,
    ) {
        let motion = crank(theta, omega, alpha);
        let at = |t: f64| {
            let (angle, omega, alpha) = motion(t);
            Bench::new()
                .fixed("O2", 0.0, 2.0)
                .fixed("O4", 0.0, 0.0)
                .bar(2, "O2", "A", r)
                .link(4, &["O4", "B"], Form::Shape(vec![[Given::exact(0.0); 2], [number(4.0), number(0.5)]]))
                .bar(5, "B", "C", 5.0)
                .near("B", 0.0, 4.0)
                .near("C", 5.0, 4.0)
                .pin_slides("A", block.then_some(3), |b| {
                    let mut guide = b.straight(4, Ok("O4"), tilt);
                    if let crate::mechanism::Path::Straight { offset: o, .. } = &mut guide.path {
                        *o = number(offset);
                    }
                    guide
                })
                .pin_slides("C", None, |b| b.straight(1, Err([0.0, 4.2]), 0.0))
                .drive(2, Some(angle), omega, alpha)
        };
        check_by_differences(at, &["A", "B", "C"], &[4, 5]);
    }

    #[test]
    fn rod_through_a_swivel(theta in 0.0..6.2, omega in -3.0..3.0, alpha in -3.0..3.0, r in 0.4..1.5) {
        let motion = crank(theta, omega, alpha);
        let at = |t: f64| {
            let (angle, omega, alpha) = motion(t);
            Bench::new()
                .fixed("O2", 0.0, 0.0)
                .fixed("O4", 3.0, 0.3)
                .bar(2, "O2", "A", r)
                .bar(3, "A", "E", 6.0)
                .link(4, &["O4"], Form::Single)
                .link_slides(3, Some(std::f64::consts::PI), |b| b.straight(4, Ok("O4"), 0.0))
                .drive(2, Some(angle), omega, alpha)
        };
        check_by_differences(at, &["A", "E"], &[3, 4]);
        // The swivel looks at the crank pin, the rod past it.
        let s = at(0.0).solve();
        let d = [s.at("A")[0] - 3.0, s.at("A")[1] - 0.3];
        near(s.scalar(Quantity::Angle(s.l(4))), libm::atan2(d[1], d[0]), 1e-13);
    }

    #[test]
    fn arc_guides(
        theta in 0.0..6.2, omega in -3.0..3.0, alpha in -3.0..3.0, r in 0.3..0.8, block in any::<bool>(),
        moving in any::<bool>(),
    ) {
        let motion = crank(theta, omega, alpha);
        let at = |t: f64| {
            let (angle, omega, alpha) = motion(t);
            let bench = Bench::new().fixed("O2", 0.0, 0.0).fixed("Q", 4.0, -3.0).bar(2, "O2", "A", r);
            let bench = if moving {
                // The slot's centre C is carried by a rocker about Q, which the pin turns.
                bench
                    .bar(4, "Q", "C", 3.5)
                    .near("C", 6.9, -1.0)
                    .pin_slides("A", block.then_some(3), |b| b.arc(4, "C", 6.5))
            } else {
                bench.bar(5, "A", "B", 4.0).near("B", 4.0, 0.2)
                    .pin_slides("B", block.then_some(3), |b| b.arc(1, "Q", 3.2))
            };
            bench.drive(2, Some(angle), omega, alpha)
        };
        let mut links = vec![if moving { 4 } else { 5 }];
        if block {
            links.push(3);
        }
        check_by_differences(at, &[if moving { "C" } else { "B" }], &links);
        let s = at(0.0).solve();
        let (pin, link) = if moving { (s.p("A"), s.l(4)) } else { (s.p("B"), s.l(1)) };
        let whole = s.vector(Quantity::SlipAcceleration(pin, link));
        let (n, t) = (s.vector(Quantity::SlipNormal(pin, link)), s.vector(Quantity::SlipTangential(pin, link)));
        let size = 1.0 + libm::hypot(whole[0], whole[1]);
        both([n[0] + t[0], n[1] + t[1]], whole, 1e-11 * size);
        if block {
            let place = s.at(if moving { "A" } else { "B" });
            let centre = s.at(if moving { "C" } else { "Q" });
            both(s.vector(Quantity::Centre(s.l(3), link)), centre, 1e-12);
            // Its own x-axis points along the radius, outward.
            let outward = libm::atan2(place[1] - centre[1], place[0] - centre[0]);
            let off = s.scalar(Quantity::Angle(s.l(3))) - outward;
            near(libm::sin(off), 0.0, 1e-12);
            near(libm::cos(off), 1.0, 1e-12);
        }
    }

    #[test]
    fn driven_slides_and_yokes(at0 in 1.2..2.4, velocity in -2.0..2.0, acceleration in -2.0..2.0) {
        // A driven slider turns a crank, whose pin moves a yoke that slides sideways.
        let at = |t: f64| {
            let place = at0 + velocity * t + acceleration * t * t / 2.0;
            Bench::new()
                .fixed("O2", 0.0, 0.0)
                .bar(2, "O2", "A", 1.0)
                .bar(3, "A", "B", 1.9)
                .link(5, &["S", "T"], Form::Shape(vec![[Given::exact(0.0); 2], [number(0.2), number(1.0)]]))
                .near("A", 0.4, 0.9)
                .near("B", 2.0, 0.0)
                .near("S", 0.4, 0.0)
                .pin_slides("B", Some(4), |b| b.straight(1, Ok("O2"), 0.0))
                .link_slides(5, Some(0.3), |b| b.straight(1, Err([0.0, -0.2]), 15.0))
                .pin_slides("A", None, |b| b.straight(5, Ok("S"), 80.0))
                .push(0, Some(place), velocity + acceleration * t, acceleration)
        };
        check_by_differences(at, &["A", "B", "S", "T"], &[2, 3, 5]);
        let s = at(0.0).solve();
        near(s.v("B")[0], velocity, 1e-14);
        near(s.a("B")[0], acceleration, 1e-13);
        near(s.scalar(Quantity::Angle(s.l(5))), 15.0_f64.to_radians() + 0.3, 1e-14);
    }

    #[test]
    fn a_cylinder_lifts_a_boom(reach in 1.6..3.4, velocity in -1.0..1.0, acceleration in -1.0..1.0) {
        // The swivelling cylinder 2 carries the guide, the rod 3 rides in it, its pin A is on the boom 4.
        let at = |t: f64| {
            let place = reach + velocity * t + acceleration * t * t / 2.0;
            Bench::new()
                .fixed("O2", 0.0, 0.0)
                .fixed("O4", 3.0, 0.5)
                .link(2, &["O2"], Form::Single)
                .link(3, &["A"], Form::Single)
                .link(4, &["O4", "A", "T"], Form::Line(vec![Given::exact(0.0), number(1.0), number(2.0)]))
                .near("A", 2.5, 1.5)
                .link_slides(3, Some(0.0), |b| b.straight(2, Ok("O2"), 0.0))
                .push(0, Some(place), velocity + acceleration * t, acceleration)
        };
        prop_assume!(f64::abs(reach - f64::sqrt(9.25)) < 0.9);
        check_by_differences(at, &["A", "T"], &[2, 3, 4]);
        // |O2 A| is the stroke.
        let s = at(0.0).solve();
        let a = s.at("A");
        near(libm::hypot(a[0], a[1]), reach, 1e-13);
        near(s.length(Quantity::Slip(s.p("A"), s.l(2))), f64::abs(velocity), 1e-12);
    }

    #[test]
    fn two_inputs_of_a_five_bar(a in 1.2..2.2, b in 0.6..1.4, wa in -2.0..2.0, wb in -2.0..2.0) {
        let at = |t: f64| {
            Bench::new()
                .fixed("O", 0.0, 0.0)
                .fixed("Q", 3.0, 0.0)
                .bar(2, "O", "A", 1.0)
                .bar(3, "A", "P", 2.5)
                .bar(4, "B", "P", 2.5)
                .bar(5, "Q", "B", 1.0)
                .near("P", 1.5, 3.0)
                .drive(2, Some(a + wa * t), wa, 0.0)
                .drive(5, Some(b + wb * t), wb, 0.0)
        };
        check_by_differences(at, &["P"], &[3, 4]);
    }

    #[test]
    fn a_coupler_can_drive(theta in -0.3..0.3, omega in -2.0..2.0, alpha in -2.0..2.0) {
        // No dyad is left when the coupler of a four-bar is driven: the whole loop is one group.
        let motion = crank(theta, omega, alpha);
        let at = |t: f64| {
            let (angle, omega, alpha) = motion(t);
            Bench::new()
                .fixed("O2", 0.0, 0.0)
                .fixed("O4", 4.0, 0.0)
                .bar(2, "O2", "A", 2.0)
                .link(3, &["A", "B", "P"], Form::Arms { second: number(3.0), third: number(1.5), angle: number(0.7) })
                .bar(4, "O4", "B", 2.3)
                .near("A", 0.0, 2.0)
                .near("B", 3.0, 2.0)
                .drive(3, Some(angle), omega, alpha)
        };
        check_by_differences(at, &["A", "B", "P"], &[2, 4]);
    }

    #[test]
    fn a_contact_that_nothing_else_holds(theta in 0.0..6.2, omega in -3.0..3.0, alpha in -3.0..3.0) {
        // A roller on a follower arm rolls on an eccentric disc: C, A and the arm are a four-bar whose
        // coupler is as long as the two radii together.
        let arm = |b: Bench| b.fixed("O4", 0.0, 0.0).fixed("O2", 4.0, 0.0).bar(4, "O4", "C", 0.6)
            .bar(2, "O2", "A", 3.0).near("A", 2.0, 2.5).drive(4, Some(theta), omega, alpha);
        let cam = arm(Bench::new())
            .link(3, &["A"], Form::Single)
            .gears([4, 3], ["C", "A"], [2.2, 0.7], false)
            .solve();
        let bar = arm(Bench::new()).bar(3, "C", "A", 2.9).solve();
        near(cam.omega(2), bar.omega(2), 1e-11);
        near(cam.alpha(2), bar.alpha(2), 1e-10);
        // Willis, in the carrier that the coupler is.
        let (carrier, turn) = (bar.omega(3), bar.alpha(3));
        near(2.2 * (omega - carrier) + 0.7 * (cam.omega(3) - carrier), 0.0, 1e-10);
        near(2.2 * (alpha - turn) + 0.7 * (cam.alpha(3) - turn), 0.0, 1e-9);
    }

    #[test]
    fn a_wheel_on_a_swinging_plane(theta in 0.5..2.6, omega in -3.0..3.0, alpha in -3.0..3.0) {
        let motion = crank(theta, omega, alpha);
        let at = |t: f64| {
            let (angle, omega, alpha) = motion(t);
            Bench::new()
                .fixed("O2", 0.0, 0.0)
                .fixed("O4", -2.0, -1.0)
                .bar(2, "O2", "A", 1.0)
                .bar(4, "O4", "P", 5.0)
                .link(3, &["A"], Form::Single)
                .near("P", 3.0, -1.0)
                .rack(3, "A", 0.4, |b| b.straight(4, Ok("O4"), 0.0))
                .drive(2, Some(angle), omega, alpha)
        };
        check_by_differences(at, &["A", "P"], &[4]);
        // The wheel rolls the way that its centre goes along the plane: s² = |O4 A|² − r², and it stands
        // on the plane's left: s′ = −r (ω₃ − ω₄).
        let s = at(0.0).solve();
        let (a, v) = (s.at("A"), s.v("A"));
        let d = [a[0] + 2.0, a[1] + 1.0];
        let along = (d[0] * d[0] + d[1] * d[1] - 0.16).sqrt();
        let rate = (d[0] * v[0] + d[1] * v[1]) / along;
        near(s.omega(3) - s.omega(4), -rate / 0.4, 1e-10);
    }

    #[test]
    fn planetary_trains_obey_willis(sun in 10..40_u32, planet in 8..30_u32, arm in -3.0..3.0, angle in 0.0..6.2) {
        let (z1, z3) = (f64::from(sun), f64::from(planet));
        let ring = z1 + 2.0 * z3;
        let s = Bench::new()
            .fixed("O", 0.0, 0.0)
            .link(2, &["O"], Form::Single)
            .bar(4, "O", "A", z1 + z3)
            .link(3, &["A"], Form::Single)
            .gears([2, 3], ["O", "A"], [z1, z3], false)
            .gears([3, 1], ["A", "O"], [z3, ring], true)
            .drive(4, Some(angle), arm, 0.7)
            .solve();
        near(s.omega(2), arm * (1.0 + ring / z1), 1e-10);
        near(s.omega(3), arm * (1.0 - ring / z3), 1e-10);
        near(s.alpha(2), 0.7 * (1.0 + ring / z1), 1e-10);
        near(s.alpha(3), 0.7 * (1.0 - ring / z3), 1e-10);
    }

    #[test]
    fn units_and_far_origins_change_nothing(
        theta in 0.3..2.8, length in -9..6_i32, rate in -9..9_i32, far in any::<bool>(),
    ) {
        let (l, w) = (libm::pow(10.0, f64::from(length)), libm::pow(10.0, f64::from(rate)));
        let make = |l: f64, w: f64, x: f64| Bench::new()
            .fixed("O2", x, -x)
            .fixed("O4", x + 4.0 * l, -x)
            .bar(2, "O2", "A", 1.0 * l)
            .bar(3, "A", "B", 4.0 * l)
            .bar(4, "O4", "B", 2.5 * l)
            .near("B", x + 4.0 * l, -x + 2.5 * l)
            .drive(2, Some(theta), 2.0 * w, w * w)
            .solve();
        let one = make(1.0, 1.0, 0.0);
        // Four is exact beside 2^27.
        let other = if far { make(1.0, w, 134_217_728.0) } else { make(l, w, 0.0) };
        let l = if far { 1.0 } else { l };
        let precise = |q: Quantity, unit: f64| {
            let (one, other, (_, bound)) = (one.scalar(q), other.scalar(q), other.bounded(q));
            near(other / unit, one, 1e-12 * (1.0 + one.abs()));
            assert!(far || bound / unit < 1e-12 * (1.0 + one.abs()), "{q:?}: {bound:e}");
        };
        precise(Quantity::Omega(one.l(3)), w);
        precise(Quantity::Omega(one.l(4)), w);
        precise(Quantity::Alpha(one.l(4)), w * w);
        let b = one.v("B");
        both(other.v("B").map(|v| v / (l * w)), b, 1e-12 * (1.0 + libm::hypot(b[0], b[1])));
        prop_assert!(other.vector_bound(Quantity::Position(one.p("B"))) > 0.0);
    }

    #[test]
    fn bounds_cover_what_the_given_numbers_leave_open(
        theta in 0.3..2.8, signs in prop::collection::vec(-1.0..1.0_f64, 32),
    ) {
        let bench = Bench::new()
            .fixed("O2", 0.0, 0.0)
            .fixed("O4", 4.0, 0.5)
            .bar(2, "O2", "A", 1.0)
            .link(3, &["A", "B", "P"], Form::Sides {
                first_second: number(4.0), second_third: number(2.0), third_first: number(2.5), turn: Sense::Cw,
            })
            .bar(4, "O4", "B", 2.5)
            .near("B", 4.0, 2.5)
            .link(6, &["O4"], Form::Single)
            .pin_slides("P", Some(5), |b| b.straight(6, Ok("O4"), 0.0))
            .drive(2, Some(theta), 2.0, -1.0);
        let mut loose = bench.done();
        for given in givens(&mut loose) {
            given.error += 1e-8 * given.value.abs().max(0.1);
        }
        let mut moved = loose.clone();
        for (given, sign) in givens(&mut moved).into_iter().zip(&signs) {
            // A number at the edge, or inside, of what it may mean.
            given.value += given.error * if sign.abs() > 0.3 { sign.signum() } else { *sign };
            given.error = 0.0;
        }
        let solve = |m: Mechanism| {
            let state = crate::analytic::solve(&m, crate::mechanism::quantity::Order::Acceleration);
            Solution { state: state.unwrap(), m }
        };
        let (loose, moved) = (solve(loose), solve(moved));
        let (p, four, six) = (loose.p("P"), loose.l(4), loose.l(6));
        let mut widest = 0.0_f64;
        for q in [
            Quantity::Omega(four), Quantity::Alpha(four), Quantity::Omega(six), Quantity::Alpha(six),
            Quantity::Angle(six), Quantity::Transmission(loose.l(3), four), Quantity::RelativeOmega(loose.l(3), six),
        ] {
            let (value, bound) = loose.bounded(q);
            let miss = (moved.scalar(q) - value).abs();
            prop_assert!(miss <= bound, "{q:?}: {miss:e} > {bound:e}");
            prop_assert!(bound < 1e-4 * (1.0 + value.abs()), "{q:?}: {bound:e}");
            widest = widest.max(miss / bound);
        }
        for q in [
            Quantity::Position(p), Quantity::Velocity(p), Quantity::Acceleration(p), Quantity::Slip(p, six),
            Quantity::SlipAcceleration(p, six), Quantity::Coriolis(p, six), Quantity::Tangential(loose.p("B")),
            Quantity::Centre(loose.l(1), loose.l(3)),
        ] {
            let Answer::Vector { value, bound } = loose.state.answer(&q) else { continue };
            let other = moved.vector(q);
            let miss = libm::hypot(value[0] - other[0], value[1] - other[1]);
            prop_assert!(miss <= bound, "{q:?}: {miss:e} > {bound:e}");
            widest = widest.max(miss / bound);
        }
        // The bound is a bound, not a shrug.
        prop_assert!(widest > 0.02, "{widest}");
    }

    #[test]
    fn a_four_bar_agrees_with_its_closed_form_within_its_bound(
        theta in 0.0..6.2, r2 in 0.3..0.9, r3 in 2.5..3.5, r4 in 2.0..3.0, omega in -5.0..5.0,
    ) {
        // Freudenstein's loop, ω4 = ω2 r2 sin(θ2 − θ3) / (r4 sin(θ4 − θ3)).
        let s = Bench::new()
            .fixed("O2", 0.0, 0.0)
            .fixed("O4", 3.0, 0.0)
            .bar(2, "O2", "A", r2)
            .bar(3, "A", "B", r3)
            .bar(4, "O4", "B", r4)
            .near("B", 3.0, 3.0)
            .drive(2, Some(theta), omega, 0.0)
            .solve();
        let a = [r2 * libm::cos(theta), r2 * libm::sin(theta)];
        let d = libm::hypot(3.0 - a[0], a[1]);
        let base = libm::atan2(-a[1], 3.0 - a[0]);
        let at_a = libm::acos((r3 * r3 + d * d - r4 * r4) / (2.0 * r3 * d));
        let theta3 = base + at_a;
        let b = [a[0] + r3 * libm::cos(theta3), a[1] + r3 * libm::sin(theta3)];
        let theta4 = libm::atan2(b[1], b[0] - 3.0);
        let omega4 = omega * r2 * libm::sin(theta - theta3) / (r4 * libm::sin(theta4 - theta3));
        let omega3 = omega * r2 * libm::sin(theta4 - theta) / (r3 * libm::sin(theta3 - theta4));
        for (n, expected) in [(4, omega4), (3, omega3)] {
            let (value, bound) = s.bounded(Quantity::Omega(s.l(n)));
            near(value, expected, bound + 2e-13 * (1.0 + expected.abs()));
            prop_assert!(bound < 1e-13 * (1.0 + value.abs()), "{bound:e}");
        }
        let gamma = (theta4 - theta3).abs();
        let gamma = if gamma > std::f64::consts::PI { std::f64::consts::TAU - gamma } else { gamma };
        near(s.scalar(Quantity::Transmission(s.l(3), s.l(4))), gamma, 1e-12);
    }
}

/// Every given number of a mechanism.
fn givens(m: &mut Mechanism) -> Vec<&mut Given> {
    let mut all = Vec::new();
    for point in &mut m.points {
        if let Place::Fixed(place) | Place::Placed(place) = &mut point.place {
            all.extend(place.iter_mut());
        }
    }
    for link in &mut m.links {
        match &mut link.form {
            Form::Length(length) => all.push(length),
            Form::Sides { first_second, second_third, third_first, .. } => {
                all.extend([first_second, second_third, third_first]);
            }
            _ => {}
        }
    }
    for input in &mut m.inputs {
        if let Input::Angle { angle: Some(angle), omega, alpha, .. } = input {
            all.extend([angle, omega, alpha]);
        }
    }
    all
}

#[test]
fn a_wheel_rolls_the_right_way() {
    let wheel = |side: f64, v: f64| {
        Bench::new()
            .placed("C", 1.0, 0.5 * side)
            .link(2, &["C"], Form::Single)
            .pin_slides("C", Some(3), |b| b.straight(1, Err([0.0, 0.5 * side]), 0.0))
            .rack(2, "C", 0.5, |b| b.straight(1, Err([0.0, 0.0]), 0.0))
            .push(0, None, v, 3.0)
            .solve()
    };
    let on_top = wheel(1.0, 2.0);
    near(on_top.omega(2), -4.0, 1e-14);
    near(on_top.alpha(2), -6.0, 1e-14);
    both(on_top.vector(Quantity::Centre(on_top.l(2), on_top.l(1))), [1.0, 0.0], 1e-14);
    near(wheel(-1.0, 2.0).omega(2), 4.0, 1e-14);
}

#[test]
fn a_wheel_finds_its_side_of_the_line_by_its_hint() {
    // An arm of length 1 about a point of the line, a wheel of radius ½ on the line: four places.
    let bench = |x: f64, y: f64| {
        Bench::new()
            .fixed("O", 0.0, 0.0)
            .bar(2, "O", "A", 1.0)
            .link(3, &["A"], Form::Single)
            .near("A", x, y)
            .rack(3, "A", 0.5, |b| b.straight(1, Ok("O"), 0.0))
    };
    let x = (0.75_f64).sqrt();
    for (side, up) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        both(bench(0.7 * side, 0.3 * up).solve().at("A"), [x * side, 0.5 * up], 1e-15);
    }
    assert!(matches!(bench(0.7, 0.0).try_solve().err(), Some(AnalyticError::Ambiguous { .. })));
}

#[test]
fn a_rack_turns_the_wheel_on_its_side() {
    for side in [1.0, -1.0] {
        let s = Bench::new()
            .fixed("O", 0.0, 0.5 * side)
            .link(2, &["O"], Form::Single)
            .bar(3, "S", "T", 4.0)
            .near("S", -1.0, 0.0)
            .link_slides(3, Some(0.0), |b| b.straight(1, Err([0.0, 0.0]), 0.0))
            .rack(2, "O", 0.5, |b| b.straight(3, Ok("S"), 0.0))
            .push(0, Some(-1.0), 2.0, 1.0)
            .solve();
        near(s.omega(2), 4.0 * side, 1e-13);
        near(s.alpha(2), 2.0 * side, 1e-13);
    }
}

#[test]
fn cardan_circles_draw_a_straight_line() {
    // A circle rolling inside one twice as large: every point of its rim goes through the centre.
    let (angle, r) = (0.7_f64, 1.0);
    let carrier = [r * libm::cos(angle), r * libm::sin(angle)];
    let s = Bench::new()
        .fixed("O", 0.0, 0.0)
        .placed("A", carrier[0], carrier[1])
        .placed("P", 2.0 * carrier[0], 0.0)
        .link(2, &["O", "A"], Form::Placed)
        .link(3, &["A", "P"], Form::Placed)
        .gears([1, 3], ["O", "A"], [2.0, 1.0], true)
        .drive(2, None, 3.0, 0.5)
        .solve();
    near(s.omega(3), -3.0, 1e-13);
    // x = 2 r cos θ.
    let (sin, cos) = libm::sincos(angle);
    both(s.v("P"), [-2.0 * sin * 3.0, 0.0], 1e-13);
    both(s.a("P"), [-2.0 * (cos * 9.0 + sin * 0.5), 0.0], 1e-12);
}

#[test]
fn links_that_ride_as_placed_do_not_turn() {
    // A placed yoke on a placed carriage that is turned by a crank.
    let s = Bench::new()
        .fixed("O", 0.0, 0.0)
        .placed("A", 2.0, 0.0)
        .placed("B", 3.0, 1.0)
        .placed("P", 4.0, 1.5)
        .link(2, &["O", "A"], Form::Placed)
        .link(3, &["B", "P"], Form::Placed)
        .link_slides(3, None, |b| b.straight(2, Err([2.0, 0.0]), 45.0))
        .drive(2, None, 2.0, 0.0)
        .push(0, None, 0.5, 0.0)
        .solve();
    near(s.omega(3), 2.0, 1e-14);
    let c = 0.5 * std::f64::consts::FRAC_1_SQRT_2;
    both(s.v("B"), [-2.0 + c, 6.0 + c], 1e-13);
    // −ω² r plus Coriolis.
    both(s.a("B"), [-12.0 - 4.0 * c, -4.0 + 4.0 * c], 1e-12);
    near(s.length(Quantity::Slip(s.p("B"), s.l(2))), 0.5, 1e-14);
}

#[test]
fn a_pin_in_two_slots_needs_no_link() {
    // Two cranks' slots cross at P.
    let at = |t: f64| {
        Bench::new()
            .fixed("O", 0.0, 0.0)
            .fixed("Q", 4.0, 0.0)
            .bar(2, "O", "A", 1.0)
            .bar(3, "Q", "B", 1.0)
            .pin_slides("P", None, |b| b.straight(2, Ok("O"), 0.0))
            .pin_slides("P", None, |b| b.straight(3, Ok("Q"), 0.0))
            .drive(2, Some(0.6 + t), 1.0, 0.0)
            .drive(3, Some(2.0 + 0.5 * t), 0.5, 0.0)
    };
    check_by_differences(at, &["P"], &[2, 3]);
}

fn slider_crank(theta: f64) -> Bench {
    Bench::new()
        .fixed("O2", 0.0, 0.0)
        .placed("A", libm::cos(theta), libm::sin(theta))
        .link(2, &["O2", "A"], Form::Placed)
        .bar(3, "A", "B", 3.0)
        .near("B", 4.0, 0.0)
        .pin_slides("B", Some(4), |b| b.straight(1, Ok("O2"), 0.0))
}

#[test]
fn a_dead_centre_refuses_only_what_depends_on_it() {
    // The piston cannot turn the crank at top dead centre, but it keeps its own velocity.
    let s = slider_crank(0.0).push(0, None, 2.0, 0.0).solve();
    for quantity in [Quantity::Omega(s.l(2)), Quantity::Alpha(s.l(3)), Quantity::Velocity(s.p("A"))] {
        assert_eq!(s.refused(quantity), Indeterminate::Singular);
    }
    both(s.at("B"), [4.0, 0.0], 1e-12);
    // The crank moves the piston through it.
    let s = slider_crank(0.0).drive(2, None, 2.0, 0.0).solve();
    both(s.v("B"), [0.0; 2], 1e-14);
    near(s.omega(3), -2.0 / 3.0, 1e-14);
    // a = −ω² r (1 + r/l).
    near(s.a("B")[0], -4.0 * (1.0 + 1.0 / 3.0), 1e-13);
    // Near it the answer is right to its bound.
    for d in [1e-3, 1e-6, 1e-9] {
        let s = slider_crank(d).push(0, None, 2.0, 0.0).solve();
        let exact = -2.0 / (libm::sin(d) * (1.0 + libm::cos(d) / (9.0 - libm::sin(d) * libm::sin(d)).sqrt()));
        let (value, bound) = s.bounded(Quantity::Omega(s.l(2)));
        near(value, exact, bound);
        assert!(bound < 1e-3 * exact.abs(), "{d}: {value} ± {bound}");
    }
}

#[test]
fn a_stretched_rocker_has_a_place_but_no_motion() {
    // O2 A B O4 = 3, 4, 7 wide: coupler and rocker in line, reached exactly.
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O4", 10.0, 0.0)
        .bar(2, "O2", "A", 3.0)
        .bar(3, "A", "B", 4.0)
        .bar(4, "O4", "B", 3.0)
        .drive(2, Some(0.0), 1.0, 0.0)
        .solve();
    assert_eq!(s.refused(Quantity::Omega(s.l(4))), Indeterminate::Singular);
    assert_eq!(s.refused(Quantity::Velocity(s.p("B"))), Indeterminate::Singular);
    both(s.v("A"), [0.0, 3.0], 1e-14);
    near(s.omega(2), 1.0, 1e-15);
    let b = s.at("B");
    let bound = s.vector_bound(Quantity::Position(s.p("B")));
    assert!(libm::hypot(b[0] - 7.0, b[1]) <= bound && bound < 1e-5, "{b:?} ± {bound:e}");
}

#[test]
fn what_does_not_reach_cannot_be_assembled() {
    let error = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O4", 10.0, 0.0)
        .bar(2, "O2", "A", 3.0)
        .bar(3, "A", "B", 2.0)
        .bar(4, "O4", "B", 3.0)
        .drive(2, Some(0.5), 1.0, 0.0)
        .try_solve()
        .err();
    match error {
        Some(AnalyticError::CannotAssemble { links, residual }) => {
            assert!(links.contains(&3) || links.contains(&4), "{links:?}");
            assert!(residual > 0.1 && residual < 10.0, "{residual}");
        }
        other => panic!("{other:?}"),
    }
    // A triangle that does not close.
    let error = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .link(
            2,
            &["O2", "A", "B"],
            Form::Sides {
                first_second: number(1.0),
                second_third: number(1.0),
                third_first: number(3.0),
                turn: Sense::Ccw,
            },
        )
        .drive(2, Some(0.5), 1.0, 0.0)
        .try_solve()
        .err();
    assert!(matches!(error, Some(AnalyticError::CannotAssemble { .. })), "{error:?}");
}

#[test]
fn two_assemblies_without_a_hint_are_ambiguous() {
    let bench = || {
        Bench::new()
            .fixed("O2", 0.0, 0.0)
            .fixed("O4", 4.0, 0.0)
            .bar(2, "O2", "A", 1.0)
            .bar(3, "A", "B", 4.0)
            .link(4, &["O4", "B", "C"], Form::Line(vec![Given::exact(0.0), number(2.5), number(-2.0)]))
            .drive(2, Some(QUARTER), 1.0, 0.0)
    };
    match bench().try_solve().err() {
        Some(AnalyticError::Ambiguous { points }) => assert_eq!(points, ["B", "C"]),
        other => panic!("{other:?}"),
    }
    // A hint of a point that follows decides as well.
    let below = bench().near("C", 4.0, 2.0).solve();
    assert!(below.at("B")[1] < 0.0);
    // So does a later group that only one of them can close.
    let reach = bench()
        .bar(5, "C", "D", 1.0)
        .pin_slides("D", None, |b| b.straight(1, Err([0.0, -2.5]), 0.0))
        .near("D", 5.0, -2.5)
        .solve();
    assert!(reach.at("B")[1] > 0.0);
}

#[test]
fn centres_need_no_speed() {
    let bench = |omega| {
        Bench::new()
            .fixed("O2", 0.0, 0.0)
            .fixed("O4", 4.0, 0.0)
            .bar(2, "O2", "A", 1.0)
            .bar(3, "A", "B", 4.0)
            .bar(4, "O4", "B", 2.5)
            .near("B", 4.0, 2.5)
            .drive(2, Some(1.0), omega, 0.0)
            .solve()
    };
    let (still, moving) = (bench(0.0), bench(5.0));
    let (l1, l2, l3, l4) = (still.l(1), still.l(2), still.l(3), still.l(4));
    for (a, b) in [(l1, l3), (l2, l4), (l1, l2), (l3, l4)] {
        both(still.vector(Quantity::Centre(a, b)), moving.vector(Quantity::Centre(a, b)), 1e-11);
    }
    // Kennedy: the centres of three links are in line.
    let line = |p: [[f64; 2]; 3]| {
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])
    };
    let i = |a, b| moving.vector(Quantity::Centre(a, b));
    near(line([i(l1, l2), i(l2, l4), i(l1, l4)]), 0.0, 1e-11);
    near(line([i(l1, l2), i(l2, l3), i(l1, l3)]), 0.0, 1e-11);
    assert!(matches!(still.refused(Quantity::Centre(l3, l3)), Indeterminate::Undefined { .. }));
    assert!(matches!(still.refused(Quantity::Rub(still.p("A"), l2, l3)), Indeterminate::Undefined { .. }));
}

#[test]
fn a_parallelogram_translates_its_coupler() {
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O4", 3.0, 0.0)
        .bar(2, "O2", "A", 1.0)
        .bar(3, "A", "B", 3.0)
        .bar(4, "O4", "B", 1.0)
        .near("B", 3.5, 0.8)
        .drive(2, Some(1.0), 2.0, 0.0)
        .solve();
    near(s.omega(3), 0.0, 1e-14);
    match s.state.answer(&Quantity::Centre(s.l(1), s.l(3))) {
        Answer::AtInfinity { direction, bound } => {
            near(direction[0] * libm::sin(1.0) - direction[1] * libm::cos(1.0), 0.0, bound);
            assert!(bound < 1e-13);
        }
        other => panic!("{other:?}"),
    }
    // Links 2 and 4 turn alike: their centre is at infinity along the frame.
    assert!(matches!(s.state.answer(&Quantity::Centre(s.l(2), s.l(4))), Answer::AtInfinity { .. }));
}

#[test]
fn a_chain_of_two_hundred_links_keeps_its_accuracy() {
    let mut bench = Bench::new().fixed("O", 0.0, 0.0).bar(2, "O", "P0", 1.0).drive(2, Some(1.0), 1.0, 0.5);
    // A chain of parallelograms: every rocker turns as the crank does.
    for k in 0..100_u32 {
        let (last, next, pivot) = (format!("P{k}"), format!("P{}", k + 1), format!("Q{k}"));
        let x = 3.0 * f64::from(k + 1);
        bench = bench
            .fixed(&pivot, x, 0.0)
            .bar(3 + 2 * k, &last, &next, 3.0)
            .bar(4 + 2 * k, &pivot, &next, 1.0)
            .near(&next, x + 0.5, 0.8);
    }
    let s = bench.solve();
    let (value, bound) = s.bounded(Quantity::Omega(s.l(202)));
    near(value, 1.0, bound);
    assert!(bound < 1e-10, "{bound:e}");
    near(s.alpha(202), 0.5, 1e-10);
    assert_eq!(s.state.singular_values().len(), 603);
}

/// Four-bars that are all different, one after the other.
fn irregular_chain(dyads: u32) -> Bench {
    let mut bench = Bench::new().fixed("G0", 0.0, 0.0).bar(2, "G0", "P0", 0.06).drive(2, Some(1.4), 1.0, 2.0);
    let mut pin = [0.06 * libm::cos(1.4), 0.06 * libm::sin(1.4)];
    for i in 1..=dyads {
        let part = |k: u32| libm::sin(f64::from(7 * i + k) * 1.7);
        let base = [0.12 * f64::from(i) + 0.015 * part(0), 0.015 * part(1)];
        let next = [base[0] + 0.025 * part(2), base[1] + 0.06 + 0.01 * part(3)];
        let length = |from: [f64; 2]| libm::hypot(next[0] - from[0], next[1] - from[1]);
        let (before, here, ground) = (format!("P{}", i - 1), format!("P{i}"), format!("G{i}"));
        bench = bench
            .fixed(&ground, base[0], base[1])
            .bar(2 * i + 1, &before, &here, length(pin))
            .bar(2 * i + 2, &ground, &here, length(base))
            .near(&here, next[0], next[1]);
        pin = next;
    }
    bench
}

/// What it takes to see that the groups of a chain are regular is the same for each: no sweep goes back through all of
/// them. Sketches are no smaller than what such a sweep tells.
#[test]
fn a_long_chain_is_seen_to_be_regular_link_by_link() {
    let mut solution = irregular_chain(150).solve();
    assert_eq!(solution.state.located.swept(), 0);
    let State { model, located, .. } = &mut solution.state;
    let radii = located.sketched_and_swept(model);
    assert_eq!(radii.len(), 3 * 301);
    for [sketched, swept] in radii {
        assert!(swept <= sketched && sketched <= 1e4 * swept, "{sketched} of {swept}");
    }
}

#[test]
fn a_long_chain_without_hints_is_refused_soon() {
    let mut bench = Bench::new().fixed("O", 0.0, 0.0).bar(2, "O", "P0", 1.0).drive(2, Some(1.0), 1.0, 0.0);
    for k in 0..100_u32 {
        let (last, next, pivot) = (format!("P{k}"), format!("P{}", k + 1), format!("Q{k}"));
        bench = bench.fixed(&pivot, 3.0 * f64::from(k + 1), 0.0).bar(3 + 2 * k, &last, &next, 3.0).bar(
            4 + 2 * k,
            &pivot,
            &next,
            1.0,
        );
    }
    assert!(matches!(bench.try_solve().err(), Some(AnalyticError::Ambiguous { .. })));
}

#[test]
fn a_block_on_a_fixed_pin_is_the_swivel_seen_from_the_rod() {
    let bench = || {
        Bench::new()
            .fixed("O2", 0.0, 0.0)
            .fixed("O4", 3.0, 0.3)
            .bar(2, "O2", "A", 1.0)
            .bar(3, "A", "E", 6.0)
            .drive(2, Some(1.1), 2.0, 0.3)
    };
    let swivel = bench()
        .link(4, &["O4"], Form::Single)
        .link_slides(3, Some(std::f64::consts::PI), |b| b.straight(4, Ok("O4"), 0.0))
        .solve();
    let block =
        bench().near("E", 7.0, 0.0).pin_slides("O4", Some(4), |b| b.straight(3, Ok("A"), 0.0)).solve();
    let bare = bench().near("E", 7.0, 0.0).pin_slides("O4", None, |b| b.straight(3, Ok("A"), 0.0)).solve();
    for other in [&block, &bare] {
        both(other.at("E"), swivel.at("E"), 1e-13);
        near(other.omega(3), swivel.omega(3), 1e-13);
        near(other.alpha(3), swivel.alpha(3), 1e-12);
    }
    near(block.omega(4), swivel.omega(4), 1e-13);
    // The block's x follows the rod; the swivel's looks at the crank pin.
    near(block.scalar(Quantity::Angle(block.l(4))), block.scalar(Quantity::Angle(block.l(3))), 1e-14);
    let turned = swivel.scalar(Quantity::Angle(swivel.l(4))) - block.scalar(Quantity::Angle(block.l(4)));
    near(turned.abs(), std::f64::consts::PI, 1e-13);
}

#[test]
fn a_third_parallel_crank_is_redundant_and_agrees() {
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .fixed("O4", 3.0, 0.0)
        .fixed("O5", 1.0, 0.5)
        .bar(2, "O2", "A", 1.0)
        .link(
            3,
            &["A", "B", "C"],
            Form::Shape(vec![[Given::exact(0.0); 2], [number(3.0), number(0.0)], [number(1.0), number(0.5)]]),
        )
        .bar(4, "O4", "B", 1.0)
        .bar(5, "O5", "C", 1.0)
        .near("B", 3.5, 0.8)
        .drive(2, Some(1.0), 2.0, 0.7)
        .solve();
    for n in [4, 5] {
        near(s.omega(n), 2.0, 1e-13);
        near(s.alpha(n), 0.7, 1e-12);
    }
    near(s.omega(3), 0.0, 1e-13);
}

#[test]
fn an_idle_roller_leaves_the_rest_determined() {
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .bar(2, "O2", "A", 1.0)
        .link(3, &["A"], Form::Single)
        .drive(2, Some(1.0), 2.0, 0.7)
        .solve();
    assert_eq!(s.refused(Quantity::Omega(s.l(3))), Indeterminate::Singular);
    near(s.length(Quantity::Velocity(s.p("A"))), 2.0, 1e-14);
}

#[test]
fn a_short_crank_in_a_large_mechanism_keeps_its_digits() {
    // r/l = 1e-6: to first order in r/l the piston goes as r cos θ, exactly as r sin(θ + φ)/cos φ at speed.
    let (r, l, theta, omega) = (1e-3, 1e3, 0.8, 1e6);
    let s = Bench::new()
        .fixed("O2", 0.0, 0.0)
        .bar(2, "O2", "A", r)
        .bar(3, "A", "B", l)
        .near("B", l, 0.0)
        .pin_slides("B", Some(4), |b| b.straight(1, Ok("O2"), 0.0))
        .drive(2, Some(theta), omega, 0.0)
        .solve();
    let sin_phi = r * libm::sin(theta) / l;
    let cos_phi = (1.0 - sin_phi * sin_phi).sqrt();
    let expected = -r * omega * (libm::sin(theta) + libm::cos(theta) * sin_phi / cos_phi);
    near(s.v("B")[0], expected, 1e-12 * expected.abs());
    near(s.omega(3), -r * omega * libm::cos(theta) / (l * cos_phi), 1e-12);
    let (value, bound) = s.bounded(Quantity::Omega(s.l(3)));
    assert!(bound < 1e-12 * value.abs(), "{bound:e}");
}

#[test]
fn nonsense_is_an_error_and_never_a_panic() {
    let malformed = |bench: Bench| {
        let error = bench.try_solve().err();
        assert!(matches!(error, Some(AnalyticError::Malformed { .. })), "{error:?}");
    };
    let start = || Bench::new().fixed("O2", 0.0, 0.0);
    malformed(start().bar(2, "O2", "A", f64::NAN).drive(2, Some(0.0), 1.0, 0.0));
    malformed(start().link(2, &["O2", "A"], Form::Line(vec![number(0.0)])).drive(2, Some(0.0), 1.0, 0.0));
    malformed(start().link(2, &["O2", "A"], Form::Placed).drive(2, None, 1.0, 0.0));
    malformed(start().bar(2, "O2", "A", 1.0).drive(2, Some(f64::INFINITY), 1.0, 0.0));
    // A speed of a point that does not move about its joint.
    let bench = start().link(2, &["O2", "A"], Form::Shape(vec![[number(0.0); 2]; 2]));
    let input = Input::Speed {
        link: bench.id(2),
        angle: None,
        point: bench.clone().point("A"),
        speed: number(1.0),
        alpha: number(0.0),
    };
    assert!(bench.input(input).try_solve().is_err());
    // Quantities of nothing.
    let s = start().bar(2, "O2", "A", 1.0).drive(2, Some(0.0), 1.0, 0.0).solve();
    let nothing = Quantity::Velocity(crate::mechanism::PointId(99));
    assert!(matches!(s.refused(nothing), Indeterminate::Undefined { .. }));
    let state = crate::analytic::solve(&s.m, crate::mechanism::quantity::Order::Position).unwrap();
    let early = state.answer(&Quantity::Omega(s.l(2)));
    assert!(matches!(early, Answer::Indeterminate(Indeterminate::Undefined { .. })));
    assert_eq!(state.pose(s.p("A")).unwrap().at, [1.0, 0.0]);
}
