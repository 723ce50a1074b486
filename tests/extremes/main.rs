//! Extremes: a crank next to a dead centre or a change point, lines of centres nearly parallel, absurd ratios,
//! units, speeds and distances, the edge of assembly. In each arithmetic every answer is right within its
//! bound or refused; and where the numbers still carry digits it must be an answer.
//!
//! The expected digits stand in `tests/data/extremes.tsv`. They come from closed forms in an arithmetic of a
//! hundred digits (`tests/common/oracle.rs`) that shares nothing with the program.
//! `LINKGRAM_BLESS=1 cargo test --test all extremes::` writes them anew.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

mod campaign;
mod chain;
pub(crate) mod dice;

use std::fmt::Write;

use crate::common::exact::Exact;
use crate::common::oracle::{FOUR_BAR_QUANTITIES, FourBar, SLIDER_QUANTITIES, Slider};
use linkgram::double_double::DoubleDouble;
use linkgram::mechanism::quantity::{Answer, Indeterminate};
use linkgram::plan::Extent;
use linkgram::solve::{Arithmetic, Settings, solve_with};

/// One scene with the truth about it.
struct Case {
    name: String,
    scene: String,
    quantities: &'static [&'static str],
    truth: Option<Vec<Vec<Exact>>>,
    /// The coarsest arithmetic that must answer everything; `None` where even the finest may refuse.
    answers: Option<Arithmetic>,
}

fn texts<const N: usize>(numbers: [&str; N]) -> [String; N] {
    numbers.map(str::to_owned)
}

fn four_bar(name: String, bar: &FourBar, answers: Option<Arithmetic>) -> Case {
    Case { name, scene: bar.scene(), quantities: &FOUR_BAR_QUANTITIES, truth: bar.closed_form(), answers }
}

fn bar(lengths: [&str; 4], angle: &str) -> FourBar {
    FourBar {
        at: texts(["0", "0"]),
        lengths: texts(lengths),
        angle: angle.to_owned(),
        unit: "rad",
        rates: texts(["2", "3"]),
    }
}

fn slider(lengths: [&str; 2], angle: String) -> Slider {
    Slider { lengths: texts(lengths), angle, omega: "2".to_owned() }
}

fn slider_crank(name: String, at: &Slider, answers: Option<Arithmetic>) -> Case {
    Case { name, scene: at.scene(), quantities: &SLIDER_QUANTITIES, truth: Some(at.closed_form()), answers }
}

/// 10^−n as text.
fn power(n: i32) -> String {
    format!("1e{n}")
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let finest_to = |n: i32, single: i32, double: i32, fine: i32| {
        if n <= single {
            Some(Arithmetic::Single)
        } else if n <= double {
            Some(Arithmetic::Double)
        } else if n <= fine {
            Some(Arithmetic::DoubleDouble)
        } else {
            None
        }
    };
    // Coupler and rocker in line at a right angle of the crank: 3² + 4² = (2 + 3)².
    for n in 1..=14 {
        let quarter = Exact::pi() / Exact::ratio(2, 1) - Exact::decimal(&power(-n));
        let at = bar(["4", "3", "2", "3"], &quarter.to_decimal(80));
        cases.push(four_bar(format!("dead-centre-1e-{n}"), &at, finest_to(n, 3, 10, 14)));
    }
    // And the coupler folded back onto the rocker: 3² + 4² = (7 − 2)².
    for n in 1..=14 {
        let quarter = Exact::pi() / Exact::ratio(2, 1) + Exact::decimal(&power(-n));
        let at = bar(["4", "3", "7", "2"], &quarter.to_decimal(80));
        cases.push(four_bar(format!("folded-dead-centre-1e-{n}"), &at, finest_to(n, 3, 10, 14)));
    }
    // Links in pairs of one length, well away from the change point: the coupler translates.
    for angle in ["0.3", "1.1", "2.9"] {
        let at = bar(["2", "1", "2", "1"], angle);
        cases.push(four_bar(format!("parallelogram-{angle}"), &at, Some(Arithmetic::Single)));
    }
    // A parallelogram next to its change point: redundant, but movable.
    for n in 1..=14 {
        let at = bar(["2", "1", "2", "1"], &power(-n));
        cases.push(four_bar(format!("change-point-1e-{n}"), &at, finest_to(n, 1, 5, 12)));
    }
    // On the edge of assembly, short of it by ever less.
    for n in [1, 3, 6, 9, 12] {
        let reach = Exact::ratio(5, 1) + Exact::decimal(&power(-n)) - Exact::ratio(2, 1);
        let quarter = (Exact::pi() / Exact::ratio(2, 1)).to_decimal(80);
        let at = bar(["4", "3", "2", &reach.to_decimal(80)], &quarter);
        cases.push(four_bar(format!("edge-of-assembly-1e-{n}"), &at, finest_to(n, 3, 9, 12)));
    }
    // A crank a million times shorter than the rest, and a frame a million times shorter.
    for n in [2, 4, 6] {
        let short = power(-n);
        let at = bar(["1.7", &short, "1.3", "0.9"], "0.7");
        cases.push(four_bar(format!("short-crank-1e-{n}"), &at, Some(Arithmetic::Single)));
        let at = bar([&short, "1.1", "1.3", "0.9"], "0.7");
        cases.push(four_bar(format!("short-frame-1e-{n}"), &at, finest_to(n, 4, 6, 6)));
    }
    // From nanometres to a thousand kilometres.
    for n in [-9, -6, -3, 3, 6] {
        let [a, b, c, d] = ["1.7", "0.6", "1.3", "1.1"].map(|x| format!("{x}e{n}"));
        let at = bar([&a, &b, &c, &d], "0.7");
        cases.push(four_bar(format!("size-1e{n}"), &at, Some(Arithmetic::Single)));
    }
    for n in [-9, -5, 5, 9] {
        let mut at = bar(["1.7", "0.6", "1.3", "1.1"], "0.7");
        at.rates = [power(n), format!("3e{}", 2 * n)];
        cases.push(four_bar(format!("speed-1e{n}"), &at, Some(Arithmetic::Single)));
    }
    // Pivots far from the origin.
    for n in [2, 5, 8] {
        let mut at = bar(["1.7", "0.6", "1.3", "1.1"], "0.7");
        at.at = [power(n), format!("-3e{n}")];
        cases.push(four_bar(format!("offset-1e{n}"), &at, finest_to(n, 2, 8, 8)));
    }
    // A slider at the end of its stroke.
    for n in 1..=14 {
        let at = slider(["0.5", "1.5"], power(-n));
        cases.push(slider_crank(format!("end-of-stroke-1e-{n}"), &at, Some(Arithmetic::Single)));
    }
    // A rod shorter than its crank, ever nearer to square to its guide.
    for n in 1..=14 {
        let rod = (Exact::ratio(1, 1) + Exact::decimal(&power(-n))).to_decimal(40);
        let angle = (Exact::pi() / Exact::ratio(6, 1)).to_decimal(80);
        let at = slider(["2", &rod], angle);
        cases.push(slider_crank(format!("rod-square-to-guide-1e-{n}"), &at, finest_to(n, 4, 13, 14)));
    }
    // Gears of absurd ratio: the pitch circles roll on each other.
    for n in [2, 4, 6] {
        cases.push(gears(n));
    }
    // A slot tangent to the crank's circle, and next to it: the lever stands still and turns back.
    for n in [1, 3, 5, 7, 9, 12, 14] {
        cases.push(slot(n));
    }
    // Lines of centres ever nearer to parallel: the rocker of a parallelogram a little too long.
    for n in 1..=12 {
        let rocker = (Exact::ratio(1, 1) + Exact::decimal(&power(-n))).to_decimal(40);
        let at = bar(["2", "1", "2", &rocker], "1.1");
        let mut case = four_bar(format!("parallel-lines-of-centres-1e-{n}"), &at, finest_to(n, 4, 12, 12));
        let asked = ["omega(3)", "omega(4)"].map(|q| format!(r#"{{ "name": "{q}", "method": "centres" }}"#));
        case.scene =
            case.scene.replace(&format!("{FOUR_BAR_QUANTITIES:?}"), &format!("[{}]", asked.join(", ")));
        case.quantities = &["omega(3)", "omega(4)"];
        case.truth = case.truth.map(|truth| truth[3..5].to_vec());
        cases.push(case);
    }
    cases
}

/// Two gears, the second 10^n times as large: ω and ε by the ratio of the radii alone.
fn gears(n: i32) -> Case {
    let large = format!("1e{n}");
    let (w, e) = ("2", "3");
    let ratio = Exact::decimal(&power(-n));
    let [w3, e3] = [w, e].map(|x| -(Exact::decimal(x) * &ratio));
    let far = (Exact::decimal(&large) + Exact::ratio(1, 1)).to_decimal(20);
    Case {
        name: format!("gears-1e{n}"),
        scene: format!(
            r#"{{ "units": {{ "angle": "rad" }}, "fixed": {{ "O2": [0, 0], "O3": [{far}, 0] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": 0.5 }}, "3": {{ "joins": ["O3", "C"] }} }},
                 "placed": {{ "C": [{far}, 0.5] }},
                 "rolls": [ {{ "links": [2, 3], "centres": ["O2", "O3"], "radii": [1, {large}] }} ],
                 "input": {{ "link": 2, "angle": 0.3, "omega": "{w} rad/s", "alpha": "{e} rad/s^2" }},
                 "find": ["omega(3)", "alpha(3)"] }}"#
        ),
        quantities: &["omega(3)", "alpha(3)"],
        truth: Some(vec![vec![w3], vec![e3]]),
        answers: Some(Arithmetic::Single),
    }
}

/// A crank of 1 whose pin slides in a lever pivoted 2 below: the slot is tangent to the crank's circle where the
/// cosine of the crank's angle from the line of pivots is −½; 10^−n rad from there.
fn slot(n: i32) -> Case {
    let angle = Exact::pi() / Exact::ratio(6, 1) - Exact::decimal(&power(-n));
    // The crank's angle from +x is −30° there; the pin stands on the right.
    let angle = (-angle).to_decimal(80);
    let [cos, sin] = Exact::decimal(&angle).cos_sin();
    let (w, e) = (Exact::ratio(2, 1), Exact::ratio(3, 1));
    let arm = [cos.clone(), &sin + &Exact::ratio(2, 1)];
    let v = [-(&w * &sin), &w * &cos];
    let a = [-(&e * &sin) - &w * &w * &cos, &e * &cos - &w * &w * &sin];
    let square = &arm[0] * &arm[0] + &arm[1] * &arm[1];
    let cross = |p: &[Exact; 2], q: &[Exact; 2]| &p[0] * &q[1] - &p[1] * &q[0];
    let w4 = cross(&arm, &v) / &square;
    // d/dt of ω ρ² = ρ × v: ε = (ρ × a − 2 ω ρ·v) / ρ².
    let rise = &arm[0] * &v[0] + &arm[1] * &v[1];
    let e4 = (cross(&arm, &a) - Exact::ratio(2, 1) * &w4 * &rise) / &square;
    Case {
        name: format!("slot-tangent-1e-{n}"),
        scene: format!(
            r#"{{ "units": {{ "angle": "rad" }}, "fixed": {{ "O2": [0, 0], "O4": [0, -2] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": 1 }},
                            "4": {{ "joins": ["O4", "B"], "length": 4 }} }},
                 "slides": [ {{ "pin": "A", "block": 3, "on": {{ "link": 4, "through": "O4", "toward": "B" }} }} ],
                 "near": {{ "B": [2, 1.5] }},
                 "input": {{ "link": 2, "angle": {angle}, "omega": "2 rad/s", "alpha": "3 rad/s^2" }},
                 "find": ["omega(4)", "alpha(4)"] }}"#
        ),
        quantities: &["omega(4)", "alpha(4)"],
        truth: Some(vec![vec![w4], vec![e4]]),
        answers: Some(Arithmetic::Single),
    }
}

/// Forty digits.
fn digits(truth: &Exact) -> String {
    let size = truth.abs().near();
    let after = if size > 0.0 { (40.0 - libm::log10(size)).clamp(0.0, 110.0) } else { 1.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 110")]
    truth.to_decimal(after as u32)
}

fn table(cases: &[Case]) -> String {
    let mut out = String::from(
        "# Closed forms in an arithmetic of a hundred digits; LINKGRAM_BLESS=1 cargo test --test all extremes::\n",
    );
    for case in cases {
        match &case.truth {
            None => writeln!(out, "{}\t-\tdoes not close", case.name).unwrap(),
            Some(truth) => {
                for (quantity, numbers) in case.quantities.iter().zip(truth) {
                    let numbers: Vec<String> = numbers.iter().map(digits).collect();
                    writeln!(out, "{}\t{quantity}\t{}", case.name, numbers.join("\t")).unwrap();
                }
            }
        }
    }
    out
}

#[test]
fn the_table_is_the_oracles() {
    let path = common::root().join("tests/data/extremes.tsv");
    let table = table(&cases());
    if std::env::var_os("LINKGRAM_BLESS").is_some_and(|v| v == "1") {
        std::fs::write(&path, table).unwrap();
    } else {
        assert_eq!(std::fs::read_to_string(&path).unwrap(), table);
    }
}

/// Every answer against the digits of the table; says how many there were.
fn hold_in(arithmetic: Arithmetic) -> usize {
    let rank = |a: Arithmetic| match a {
        Arithmetic::Single => 0,
        Arithmetic::Double => 1,
        Arithmetic::DoubleDouble => 2,
        Arithmetic::Wide => 3,
    };
    let data = std::fs::read_to_string(common::root().join("tests/data/extremes.tsv")).unwrap();
    let mut answered = 0;
    for case in cases() {
        let name = format!("{} in {arithmetic:?}", case.name);
        let must = case.answers.is_some_and(|a| rank(a) <= rank(arithmetic));
        let scene = common::read(&case.scene);
        let settings = Settings { arithmetic, ..Settings::default() };
        let solved = match solve_with(&scene, Extent::Asked, &[], settings, linkgram::sheet::scale::for_scene)
        {
            Ok(solved) => solved,
            Err(error) => {
                assert!(!must, "{name}: {error}");
                assert!(error.refusal().is_some(), "{name}: {error}");
                continue;
            }
        };
        assert!(case.truth.is_some(), "{name} has an answer, but does not close");
        // How far from a dead centre the case stands; rounding grows with the third power of that.
        let apart = case.name.rsplit_once("-1e-").and_then(|(_, digits)| digits.parse::<i32>().ok());
        let unclear_from = match arithmetic {
            Arithmetic::Single => 1,
            Arithmetic::Double => 4,
            Arithmetic::DoubleDouble => 9,
            Arithmetic::Wide => i32::MAX,
        };
        let scales = ["gears", "offset", "short", "size", "speed", "parallelogram"];
        let near = !scales.iter().any(|family| case.name.starts_with(family))
            && apart.is_some_and(|digits| digits >= unclear_from);
        for (quantity, reading) in case.quantities.iter().zip(&solved.solution.construction.answers) {
            let start = format!("{}\t{quantity}\t", case.name);
            let row = data.lines().find_map(|line| line.strip_prefix(&start)).unwrap();
            let truth: Vec<Exact> = row.split('\t').map(Exact::decimal).collect();
            let (value, bound) = match &reading.answer {
                Answer::Scalar { value, bound } => (vec![*value], *bound),
                Answer::Vector { value, bound } => (value.to_vec(), *bound),
                // So near to a dead centre not three digits may be certain in the arithmetic: then there is no number.
                Answer::Indeterminate(Indeterminate::Unclear) if near => continue,
                other => {
                    assert!(!must, "{name}: {quantity} is {other:?}");
                    continue;
                }
            };
            let off = |value: &[DoubleDouble]| {
                value.iter().zip(&truth).fold(0.0, |sum, (v, t)| libm::hypot(sum, t.error_of_fine(*v)))
            };
            let doubles: Vec<DoubleDouble> = value.iter().map(|v| DoubleDouble::of(*v)).collect();
            let error = off(&doubles);
            assert!(
                error <= bound && bound.is_finite(),
                "{name}: {quantity} off by {error:e}, bound {bound:e}"
            );
            if let Some(fine) = &reading.fine {
                let error = off(&fine.value);
                assert!(error <= fine.bound, "{name}: {quantity} off by {error:e}, bound {:e}", fine.bound);
            }
            answered += 1;
        }
    }
    answered
}

#[test]
fn extremes_in_single_precision() {
    assert!(hold_in(Arithmetic::Single) > 150);
}

#[test]
fn extremes_in_double_precision() {
    assert!(hold_in(Arithmetic::Double) > 250);
}

#[test]
fn extremes_in_double_double() {
    assert!(hold_in(Arithmetic::DoubleDouble) > 350);
}
