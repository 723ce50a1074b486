//! Double-double arithmetic against a hundred digits, and the drawing in all three arithmetics against the
//! closed form of the four-bar, with its bounds.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

use crate::common::exact::Exact;
use crate::common::oracle::FourBar;
use linkgram::board::Arithmetic;
use linkgram::double_double::DoubleDouble;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::solve::{Settings, solve_with};
use linkgram::wide::Wide;
use proptest::prelude::*;

/// |value − truth| / |truth|.
fn relative(value: DoubleDouble, truth: &Exact) -> f64 {
    let size = truth.abs().near();
    let error = truth.error_of_fine(value);
    if size == 0.0 { error } else { error / size }
}

/// Doubles of both signs and of many sizes, with a tail of their own.
fn number() -> impl Strategy<Value = DoubleDouble> {
    (-1.0..1.0_f64, -40..40_i32, -1.0..1.0_f64).prop_map(|(high, power, low)| {
        let high = high * libm::pow(2.0, f64::from(power));
        DoubleDouble::sum(high, high * low * f64::EPSILON / 2.0)
    })
}

proptest! {
    #![proptest_config(common::fixed(4000))]

    #[test]
    fn the_four_operations_and_the_root_err_by_their_roundoff(a in number(), b in number()) {
        let (x, y) = (Exact::fine(a), Exact::fine(b));
        prop_assert!(relative(a + b, &(&x + &y)) <= DoubleDouble::ROUNDOFF);
        prop_assert!(relative(a - b, &(&x - &y)) <= DoubleDouble::ROUNDOFF);
        prop_assert!(relative(a * b, &(&x * &y)) <= DoubleDouble::ROUNDOFF);
        if b.hi() != 0.0 {
            prop_assert!(relative(a / b, &(&x / &y)) <= DoubleDouble::ROUNDOFF);
        }
        prop_assert!(relative(a.abs().sqrt(), &x.abs().sqrt()) <= DoubleDouble::ROUNDOFF);
    }

    #[test]
    fn nearly_equal_numbers_cancel_cleanly(a in number(), tail in -1.0..1.0_f64) {
        let b = a + DoubleDouble::of(a.hi() * tail * 1e-25);
        prop_assert!(relative(a - b, &(Exact::fine(a) - Exact::fine(b))) <= DoubleDouble::ROUNDOFF);
    }

    #[test]
    fn sines_hold_to_double_double(high in -40.0..40.0_f64, low in -1.0..1.0_f64) {
        let angle = DoubleDouble::sum(high, high * low * f64::EPSILON / 2.0);
        let (sin, cos) = angle.sin_cos();
        let [true_cos, true_sin] = Exact::fine(angle).cos_sin();
        prop_assert!(true_sin.error_of_fine(sin) <= 8.0 * DoubleDouble::ROUNDOFF, "sin {angle:?}");
        prop_assert!(true_cos.error_of_fine(cos) <= 8.0 * DoubleDouble::ROUNDOFF, "cos {angle:?}");
    }

    #[test]
    fn angles_hold_to_double_double(x in number(), y in number()) {
        prop_assume!(x.hi() != 0.0 && y.hi() != 0.0);
        let angle = y.atan2(x);
        // What is left when the vector is turned back: its own tangent.
        let [cos, sin] = Exact::fine(angle).cos_sin();
        let (ex, ey) = (Exact::fine(x), Exact::fine(y));
        let rest = (&ey * &cos - &ex * &sin) / (&ex * &cos + &ey * &sin);
        prop_assert!(rest.abs().near() <= 8.0 * DoubleDouble::ROUNDOFF * angle.abs().hi(), "{angle:?}");
    }

    #[test]
    fn decimals_are_read_and_written(
        digits in "[1-9][0-9]{0,11}\\.[0-9]{0,24}", exponent in -30..30_i32, negative in any::<bool>(),
    ) {
        let text = format!("{}{digits}e{exponent}", if negative { "-" } else { "" });
        let read = DoubleDouble::parse(&text).unwrap();
        let truth = Exact::decimal(&text);
        prop_assert!(relative(read, &truth) <= 8.0 * DoubleDouble::ROUNDOFF, "{text}: {read:?}");
        let written = Exact::decimal(&read.decimals(31));
        prop_assert!(relative(read, &written) <= 1e-29, "{text}: {}", read.decimals(31));
    }
}

/// Numbers of about 150 bits: products of them are cut off.
fn wide() -> impl Strategy<Value = Wide> {
    let double = || (-1.0..1.0_f64, -20..20_i32).prop_map(|(m, e)| m * libm::pow(2.0, f64::from(e)));
    (double(), double(), double()).prop_map(|(a, b, c)| {
        Wide::of(a) + Wide::of(b * 1e-16) * Wide::of(0.1) + Wide::of(c * 1e-32) / Wide::of(3.0)
    })
}

proptest! {
    #![proptest_config(common::fixed(1000))]

    #[test]
    fn the_reference_holds_to_seventy_five_digits(a in wide(), b in wide()) {
        let (x, y) = (Exact::wide(a), Exact::wide(b));
        let off = |value: Wide, truth: &Exact| {
            let error = (Exact::wide(value) - truth).abs().near();
            if truth.abs().near() > 0.0 { error / truth.abs().near() } else { error }
        };
        prop_assert!(off(a + b, &(&x + &y)) <= Wide::ROUNDOFF);
        prop_assert!(off(a - b, &(&x - &y)) <= Wide::ROUNDOFF);
        prop_assert!(off(a * b, &(&x * &y)) <= Wide::ROUNDOFF);
        prop_assert!(off(a / b, &(&x / &y)) <= Wide::ROUNDOFF);
        prop_assert!(off(a.abs().sqrt(), &x.abs().sqrt()) <= Wide::ROUNDOFF);
        prop_assert_eq!(a < b, x < y);
        prop_assert!((a - a) == Wide::ZERO);
    }

    #[test]
    fn the_references_angles_hold_to_seventy_five_digits(turns in -3.0..3.0_f64, tail in wide()) {
        let angle = Wide::of(turns) + tail * Wide::of(1e-20);
        let [true_cos, true_sin] = Exact::wide(angle).cos_sin();
        let (sin, cos) = angle.sin_cos();
        prop_assert!((Exact::wide(sin) - &true_sin).abs().near() <= 8.0 * Wide::ROUNDOFF);
        prop_assert!((Exact::wide(cos) - &true_cos).abs().near() <= 8.0 * Wide::ROUNDOFF);
        let back = sin.atan2(cos);
        prop_assert!((back - angle).abs().to_f64() <= 16.0 * Wide::ROUNDOFF, "{turns}: {back:?}");
    }
}

#[test]
fn the_reference_at_its_corners() {
    assert!((Exact::wide(Wide::PI) - Exact::pi()).abs().near() <= 4.0 * Wide::ROUNDOFF);
    assert!((Wide::of(1.0) / Wide::ZERO).to_f64().is_nan());
    assert!(Wide::of(f64::NAN).to_f64().is_nan());
    assert_eq!(Wide::of(-2.0).sqrt(), Wide::ZERO);
    assert_eq!(Wide::ZERO.atan2(Wide::of(-1.0)), Wide::PI);
    assert_eq!(Wide::ZERO.sin_cos(), (Wide::ZERO, Wide::of(1.0)));
    assert_eq!(Wide::of(1e300) * Wide::of(1e300) / Wide::of(1e300), Wide::of(1e300));
    let third = Wide::of(1.0) / Wide::of(3.0);
    assert_eq!(third.to_double_double(), DoubleDouble::of(1.0) / DoubleDouble::of(3.0));
    assert_eq!(third.partial_cmp(&(Wide::ZERO / Wide::ZERO)), None);
}

#[test]
fn sines_of_axes_and_small_angles() {
    let pi = DoubleDouble::PI;
    assert!(Exact::pi().error_of_fine(pi) <= 1e-32);
    for (quarters, sin, cos) in [(0.0, 0.0, 1.0), (1.0, 1.0, 0.0), (2.0, 0.0, -1.0), (3.0, -1.0, 0.0)] {
        let (s, c) = (pi * DoubleDouble::of(quarters / 2.0)).sin_cos();
        assert!((s - DoubleDouble::of(sin)).abs().hi() < 1e-31);
        assert!((c - DoubleDouble::of(cos)).abs().hi() < 1e-31);
    }
    // Small angles keep their relative error.
    let tiny = DoubleDouble::of(1e-20);
    assert!(relative(tiny.sin_cos().0, &Exact::fine(tiny).cos_sin()[1]) <= 4.0 * DoubleDouble::ROUNDOFF);
    assert_eq!(DoubleDouble::of(-1.0).sqrt(), DoubleDouble::of(0.0));
    assert_eq!(DoubleDouble::parse("nan"), None);
    assert_eq!(DoubleDouble::parse("1.2.3"), None);
    assert_eq!(DoubleDouble::parse("1e400"), None);
    assert_eq!(DoubleDouble::parse("0.000"), Some(DoubleDouble::of(0.0)));
    assert_eq!(DoubleDouble::of(0.5).decimals(3), "0.500");
    assert_eq!(DoubleDouble::of(-123_456.0).decimals(3), "-1.23e5");
    assert_eq!(DoubleDouble::of(999_999.0).decimals(2), "1.0e6");
    assert_eq!(DoubleDouble::of(42.0).decimals(2), "42");
}

fn four_bar() -> impl Strategy<Value = FourBar> {
    let length = |from: u32, to: u32| (from..to).prop_map(|n| format!("{}.{:03}", n / 1000, n % 1000));
    (length(100, 900), length(500, 2000), length(500, 2000), length(500, 2000), 0..3_600_000_u32).prop_map(
        |(crank, coupler, rocker, ground, angle)| FourBar {
            at: ["0".to_owned(), "0".to_owned()],
            lengths: [ground, crank, coupler, rocker],
            angle: format!("{}.{:04}", angle / 10_000, angle % 10_000),
            unit: "deg",
            rates: ["10".to_owned(), "5".to_owned()],
        },
    )
}

fn worst_in(arithmetic: Arithmetic, bar: &FourBar) -> Option<f64> {
    let truth = bar.closed_form()?;
    let scene = common::read(&bar.scene());
    let settings = Settings { arithmetic, ..Settings::default() };
    let solved = solve_with(&scene, Extent::Asked, &[], settings, linkgram::sheet::scale::for_scene).ok()?;
    let mut worst = 0.0_f64;
    let apart = |value: &[DoubleDouble], truth: &[Exact]| {
        value.iter().zip(truth).fold(0.0, |sum, (v, t)| libm::hypot(sum, t.error_of_fine(*v)))
    };
    for (reading, truth) in solved.solution.construction.answers.iter().zip(&truth) {
        let (value, bound) = match &reading.answer {
            Answer::Scalar { value, bound } => (vec![*value], *bound),
            Answer::Vector { value, bound } => (value.to_vec(), *bound),
            _ => continue,
        };
        let doubles: Vec<DoubleDouble> = value.iter().map(|v| DoubleDouble::of(*v)).collect();
        let error = apart(&doubles, truth);
        assert!(error <= bound, "{arithmetic:?} {bar:?}: off by {error:e}, bound {bound:e}");
        let size = truth.iter().fold(0.0, |sum, t| libm::hypot(sum, t.near()));
        if let Some(fine) = &reading.fine {
            let error = apart(&fine.value, truth);
            assert!(error <= fine.bound, "{bar:?}: off by {error:e}, bound {:e}", fine.bound);
            worst = worst.max(error / size);
        } else {
            worst = worst.max(error / size);
        }
    }
    Some(worst)
}

/// Every error within its bound, in each arithmetic; and the median four-bar right to its digits.
fn holds_in(arithmetic: Arithmetic, digits: f64) {
    let mut runner = proptest::test_runner::TestRunner::new(common::fixed(400));
    let errors = std::cell::RefCell::new(Vec::new());
    runner
        .run(&four_bar(), |bar| {
            errors.borrow_mut().extend(worst_in(arithmetic, &bar));
            Ok(())
        })
        .unwrap();
    let mut errors = errors.into_inner();
    assert!(errors.len() > 150, "only {} of 400 four-bars close", errors.len());
    errors.sort_by(f64::total_cmp);
    let median = errors[errors.len() / 2];
    assert!(median < libm::pow(10.0, -digits), "median of the worst relative errors: {median:e}");
}

#[test]
fn a_four_bar_in_single_precision() {
    holds_in(Arithmetic::Single, 5.5);
}

#[test]
fn a_four_bar_in_double_precision() {
    holds_in(Arithmetic::Double, 14.0);
}

#[test]
fn a_four_bar_in_double_double() {
    holds_in(Arithmetic::DoubleDouble, 29.0);
}
