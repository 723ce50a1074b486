//! A campaign of random chains, a tenth of them next to a dead centre as near as they like: no error beyond
//! its bound, no panic, and no bound that is always huge.
//!
//! The truth is reckoned in 75 digits by this file's own geometry: each pin by the foot of the chord, its
//! motion from the two equations that say that its distances do not change.
//!
//! ```sh
//! cargo test --release --no-default-features --test extremes -- --ignored --nocapture campaign
//! LINKGRAM_CAMPAIGN=100000 LINKGRAM_SEED=7 cargo test …   # another number, another beginning
//! ```

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::wide::Wide;

use crate::common::exact::Exact;

type Xy = [Wide; 2];

fn plus(a: Xy, b: Xy) -> Xy {
    [a[0] + b[0], a[1] + b[1]]
}

fn minus(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

fn times(a: Xy, by: Wide) -> Xy {
    [a[0] * by, a[1] * by]
}

fn dot(a: Xy, b: Xy) -> Wide {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Xy, b: Xy) -> Wide {
    a[0] * b[1] - a[1] * b[0]
}

fn near(a: Xy) -> [f64; 2] {
    a.map(Wide::to_f64)
}

/// A number as its decimals say, to all digits of the reference.
fn decimal(text: &str) -> Wide {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let mut exponent: i32 = exponent.parse().unwrap();
    let mut value = Wide::ZERO;
    let ten = Wide::of(10.0);
    let mut after_point = false;
    for c in mantissa.trim_start_matches('-').chars() {
        match c.to_digit(10) {
            Some(digit) => {
                value = value * ten + Wide::of(f64::from(digit));
                exponent -= i32::from(after_point);
            }
            None => after_point = true,
        }
    }
    for _ in 0..exponent.abs() {
        value = if exponent < 0 { value / ten } else { value * ten };
    }
    if mantissa.starts_with('-') { -value } else { value }
}

/// Dice (SplitMix64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.roll()
    }

    fn chance(&mut self, part: f64) -> bool {
        self.roll() < part
    }

    fn side(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }
}

/// A moving pin: place, velocity, acceleration.
#[derive(Clone, Copy)]
struct Pin {
    at: Xy,
    v: Xy,
    a: Xy,
}

/// A random scene with the truth about its last pin and last rod.
struct Trial {
    text: String,
    links: usize,
    /// The smallest half chord on the way, as a part of the radius.
    flat: f64,
    /// Place, velocity, acceleration, ω, ε; `None` where the chain does not close.
    truth: Option<[Vec<Wide>; 5]>,
}

struct Maker {
    dice: Dice,
    fixed: String,
    links: String,
    slides: String,
    hints: String,
    next: u32,
}

impl Maker {
    /// A number with few decimals, or to the last digit.
    fn written(value: f64, exact: bool) -> String {
        if exact { format!("{value:e}") } else { format!("{value:.4}") }
    }

    /// Writes a link of two joints; its number.
    fn link(&mut self, joints: [&str; 2], length: &str) -> u32 {
        let number = self.next;
        self.next += 1;
        let [a, b] = joints;
        let _ = write!(self.links, r#", "{number}": {{ "joins": ["{a}", "{b}"], "length": {length} }}"#);
        number
    }
}

fn trial(seed: u64) -> Trial {
    let mut dice = Dice(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let dyads = match dice.roll() {
        p if p < 0.6 => dice.between(1.0, 4.0),
        p if p < 0.9 => dice.between(4.0, 11.0),
        p if p < 0.99 => dice.between(11.0, 31.0),
        _ => dice.between(31.0, 100.0),
    } as usize;
    let singular = dice.chance(0.1).then(|| (dice.between(0.0, dyads as f64) as usize).min(dyads - 1));
    let crank = format!("{:.3}", dice.between(20.0, 80.0));
    let angle = format!("{:.4}", dice.between(0.0, 360.0));
    let omega = format!("{:.3}", dice.between(0.5, 40.0) * dice.side());
    let alpha = if dice.chance(0.3) { "0".to_owned() } else { format!("{:.2}", dice.between(-300.0, 300.0)) };
    let mut maker = Maker {
        dice,
        fixed: r#""O": [0, 0]"#.to_owned(),
        links: format!(r#""2": {{ "joins": ["O", "P0"], "length": {crank} }}"#),
        slides: String::new(),
        hints: String::new(),
        next: 3,
    };
    let (sin, cos) = (decimal(&angle) * Wide::PI / Wide::of(180.0)).sin_cos();
    let (w, e) = (decimal(&omega), decimal(&alpha));
    let arm = times([cos, sin], decimal(&crank));
    let turned = [-arm[1], arm[0]];
    let mut pin = Pin { at: arm, v: times(turned, w), a: minus(times(turned, e), times(arm, w * w)) };
    let (mut flat, mut closes) = (1.0_f64, true);
    let mut rod = (w, e);
    let mut last = 2;
    for index in 0..dyads {
        let exact = singular == Some(index);
        // The sine of the angle at which the arcs, or rod and guide, cross.
        let height = if exact {
            libm::pow(10.0, -maker.dice.between(1.0, 14.0))
        } else {
            maker.dice.between(0.35, 0.95)
        };
        let (made, number, half) = if maker.dice.chance(0.6) {
            maker.two_rods(index, pin, height, exact)
        } else {
            maker.rod_and_guide(index, pin, height, exact)
        };
        flat = flat.min(height);
        last = number;
        let Some(next) = made.filter(|_| half > 0.0) else {
            closes = false;
            break;
        };
        let (arm, v, a) = (minus(next.at, pin.at), minus(next.v, pin.v), minus(next.a, pin.a));
        let square = dot(arm, arm);
        rod = (cross(arm, v) / square, cross(arm, a) / square);
        let [x, y] = near(next.at);
        let comma = if index > 0 { ", " } else { "" };
        let _ = write!(maker.hints, r#"{comma}"P{}": [{x:e}, {y:e}]"#, index + 1);
        pin = next;
    }
    let end = if closes { format!("P{dyads}") } else { "P0".to_owned() };
    let Maker { fixed, links, slides, hints, .. } = maker;
    let text = format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ {fixed} }}, "links": {{ {links} }},
             "slides": [{slides}], "near": {{ {hints} }},
             "input": {{ "link": 2, "angle": {angle}, "omega": {omega}, "alpha": {alpha} }},
             "find": ["x({end})", "v({end})", "a({end})", "omega({last})", "alpha({last})"] }}"#
    );
    // Millimetres to metres.
    let si = |xy: Xy| xy.map(|c| c / Wide::of(1000.0)).to_vec();
    let truth = closes.then(|| [si(pin.at), si(pin.v), si(pin.a), vec![rod.0], vec![rod.1]]);
    Trial { text, links: 2 * dyads + 2, flat, truth }
}

impl Maker {
    /// A dyad of two rods: from the pin, and from a pivot. The new pin, the number of the first rod, and the
    /// half chord as a part of the first rod.
    fn two_rods(&mut self, index: usize, pin: Pin, height: f64, exact: bool) -> (Option<Pin>, u32, f64) {
        let (length, toward) =
            (self.dice.between(60.0, 150.0), self.dice.between(0.0, std::f64::consts::TAU));
        let a = near(pin.at);
        let at = |from: [f64; 2], angle: f64, l: f64| {
            [from[0] + l * libm::cos(angle), from[1] + l * libm::sin(angle)]
        };
        let p = at(a, toward, length);
        // The pivot lies where the second rod makes the wanted angle with the first, stretched or folded.
        let second = self.dice.between(0.6, 1.6) * length;
        let bend = libm::asin(height) * self.dice.side();
        let back = if self.dice.chance(0.5) { toward } else { toward + std::f64::consts::PI };
        let g = at(p, back + bend, second).map(|x| (x * 1e4).round() / 1e4);
        let names = [format!("P{index}"), format!("P{}", index + 1), format!("G{}", index + 1)];
        let [from, to, pivot] = [names[0].as_str(), names[1].as_str(), names[2].as_str()];
        // The second length closes the chain: to four decimals, or to the last digit.
        let r3 = Self::written(length, false);
        let (d, l3) = ([g[0] - a[0], g[1] - a[1]], length);
        let reach = libm::hypot(d[0], d[1]);
        let exactly = {
            // P again, with the first length as it is written.
            let along = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / reach;
            (l3 * l3 - 2.0 * along * reach + reach * reach).max(0.0).sqrt()
        };
        let r4 = Self::written(exactly, exact);
        let _ = write!(self.fixed, r#", "{pivot}": [{:.4}, {:.4}]"#, g[0], g[1]);
        let number = self.link([from, to], &r3);
        self.link([pivot, to], &r4);
        let centre = [decimal(&format!("{:.4}", g[0])), decimal(&format!("{:.4}", g[1]))];
        let (r3, r4) = (decimal(&r3), decimal(&r4));
        let d = minus(centre, pin.at);
        let square = dot(d, d);
        let along = (square + r3 * r3 - r4 * r4) / (Wide::of(2.0) * square);
        let half = r3 * r3 / square - along * along;
        if half.to_f64() <= 0.0 {
            return (None, number, 0.0);
        }
        let turn = [-d[1], d[0]];
        let side = if cross_sign(d, minus_near(p, a)) { half.sqrt() } else { -half.sqrt() };
        let arm = plus(times(d, along), times(turn, side));
        let at = plus(pin.at, arm);
        let other = minus(at, centre);
        // (P − A)·(v − v_A) = 0 and (P − G)·v = 0; then the same once more.
        let solve = |one: Wide, two: Wide| {
            let det = cross(arm, other);
            [(one * other[1] - two * arm[1]) / det, (arm[0] * two - other[0] * one) / det]
        };
        let v = solve(dot(arm, pin.v), Wide::ZERO);
        let slip = minus(v, pin.v);
        let acc = solve(dot(arm, pin.a) - dot(slip, slip), -dot(v, v));
        (Some(Pin { at, v, a: acc }), number, 1.0)
    }

    /// A rod from the pin to a block on a fixed guide.
    fn rod_and_guide(&mut self, index: usize, pin: Pin, height: f64, exact: bool) -> (Option<Pin>, u32, f64) {
        let (length, toward) =
            (self.dice.between(60.0, 150.0), self.dice.between(0.0, std::f64::consts::TAU));
        let a = near(pin.at);
        let p = [a[0] + length * libm::cos(toward), a[1] + length * libm::sin(toward)];
        // The guide makes an angle with the rod whose cosine is the height: at a right angle it is at its end.
        let guide = toward + libm::acos(height) * self.dice.side();
        let degrees = Self::written(guide.to_degrees(), exact);
        let through = [0, 1].map(|k| Self::written(p[k], exact));
        let names = [format!("P{index}"), format!("P{}", index + 1)];
        let r = Self::written(length, exact);
        let number = self.link([&names[0], &names[1]], &r);
        let comma = if self.slides.is_empty() { "" } else { ", " };
        let block = self.next;
        self.next += 1;
        let _ = write!(
            self.slides,
            r#"{comma}{{ "pin": "{}", "block": {block}, "on": {{ "link": 1, "through": [{}, {}], "angle": {degrees} }} }}"#,
            names[1], through[0], through[1]
        );
        let (sin, cos) = (decimal(&degrees) * Wide::PI / Wide::of(180.0)).sin_cos();
        let along = [cos, sin];
        let from = minus(pin.at, [decimal(&through[0]), decimal(&through[1])]);
        let off = cross(along, from);
        let r = decimal(&r);
        let half = r * r - off * off;
        if half.to_f64() <= 0.0 {
            return (None, number, 0.0);
        }
        let foot = minus(pin.at, times([-sin, cos], off));
        let ahead = (p[0] - a[0]) * cos.to_f64() + (p[1] - a[1]) * sin.to_f64() > 0.0;
        let at = plus(foot, times(along, if ahead { half.sqrt() } else { -half.sqrt() }));
        let arm = minus(at, pin.at);
        let v = times(along, dot(arm, pin.v) / dot(arm, along));
        let slip = minus(v, pin.v);
        let acc = times(along, (dot(arm, pin.a) - dot(slip, slip)) / dot(arm, along));
        (Some(Pin { at, v, a: acc }), number, 1.0)
    }
}

fn minus_near(p: [f64; 2], a: [f64; 2]) -> [f64; 2] {
    [p[0] - a[0], p[1] - a[1]]
}

/// Whether a direction lies to the left of a vector.
fn cross_sign(d: Xy, to: [f64; 2]) -> bool {
    let d = near(d);
    d[0] * to[1] - d[1] * to[0] > 0.0
}

/// What a campaign has found: bound over true error by kind of scene.
#[derive(Default)]
struct Found {
    scenes: u64,
    answers: u64,
    refused: u64,
    open: u64,
    beyond: Vec<String>,
    by_links: BTreeMap<usize, Vec<f32>>,
    by_flatness: BTreeMap<i32, Vec<f32>>,
    analytic: Vec<f32>,
}

impl Found {
    fn judge(&mut self, seed: u64, trial: &Trial, truth: &[Vec<Wide>; 5], answers: &[Answer], solver: &str) {
        for (index, (answer, truth)) in answers.iter().zip(truth).enumerate() {
            let (value, bound) = match answer {
                Answer::Scalar { value, bound } => (vec![*value], *bound),
                Answer::Vector { value, bound } => (value.to_vec(), *bound),
                _ => {
                    self.refused += 1;
                    continue;
                }
            };
            let apart = value.iter().zip(truth).map(|(v, t)| (Wide::of(*v) - *t).to_f64());
            let error = apart.fold(0.0, libm::hypot);
            self.answers += 1;
            // Written so that a not-a-number is beyond.
            let within = error <= bound;
            if !within {
                self.beyond.push(format!(
                    "seed {seed}, {solver}, quantity {index}: off by {error:e}, bound {bound:e}: {}",
                    trial.text
                ));
            }
            if error > 0.0 {
                let ratio = (bound / error) as f32;
                if solver == "analytic" {
                    self.analytic.push(ratio);
                    continue;
                }
                let links = [4, 8, 20, 62, 200].into_iter().find(|most| trial.links <= *most).unwrap_or(200);
                self.by_links.entry(links).or_default().push(ratio);
                let decade = (libm::log10(trial.flat).floor() as i32).min(-1);
                self.by_flatness.entry(decade).or_default().push(ratio);
            }
        }
    }

    fn run(&mut self, seed: u64) {
        self.scenes += 1;
        let trial = trial(seed);
        let scene = match linkgram::scene::read(&trial.text, "campaign") {
            Ok(scene) => scene,
            Err(error) => panic!("seed {seed}: {error}\n{}", trial.text),
        };
        let solved = linkgram::solve::solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene);
        let (Some(truth), Ok(solved)) = (&trial.truth, &solved) else {
            // Where arcs miss each other by less than rounding they may be taken to touch.
            match trial.truth {
                Some(_) => self.refused += 5,
                None => self.open += 1,
            }
            return;
        };
        let answers: Vec<Answer> =
            solved.solution.construction.answers.iter().map(|r| r.answer.clone()).collect();
        self.judge(seed, &trial, truth, &answers, "graphical");
        if trial.links <= 10
            && seed.is_multiple_of(10)
            && let Ok(state) = linkgram::solve::solve_analytically(&scene)
        {
            let answers: Vec<Answer> =
                scene.mechanism.asked.iter().map(|a| state.answer(&a.quantity)).collect();
            self.judge(seed, &trial, truth, &answers, "analytic");
        }
    }

    fn add(&mut self, other: Self) {
        self.scenes += other.scenes;
        self.answers += other.answers;
        self.refused += other.refused;
        self.open += other.open;
        self.beyond.extend(other.beyond);
        self.analytic.extend(other.analytic);
        for (key, ratios) in other.by_links {
            self.by_links.entry(key).or_default().extend(ratios);
        }
        for (key, ratios) in other.by_flatness {
            self.by_flatness.entry(key).or_default().extend(ratios);
        }
    }

    fn table(&mut self) -> String {
        let mut out = format!(
            "{} scenes, {} answers, {} refused, {} chains that do not close, {} errors beyond their bounds\n\n",
            self.scenes,
            self.answers,
            self.refused,
            self.open,
            self.beyond.len()
        );
        let mut row = |name: String, ratios: &mut Vec<f32>| {
            ratios.sort_by(f32::total_cmp);
            let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize];
            let _ = writeln!(
                out,
                "| {name:30} | {:9} | {:7.1} | {:7.1} | {:7.0} | {:7.0} | {:9.0} |",
                ratios.len(),
                at(0.0),
                at(0.5),
                at(0.9),
                at(0.99),
                at(1.0)
            );
        };
        row("bound over error, all".to_owned(), &mut self.by_links.values().flatten().copied().collect());
        for (links, ratios) in &mut self.by_links {
            row(format!("to {links} links"), ratios);
        }
        for (decade, ratios) in &mut self.by_flatness {
            row(format!("flattest crossing from 1e{decade}"), ratios);
        }
        if !self.analytic.is_empty() {
            row("analytic, to 10 links".to_owned(), &mut self.analytic);
        }
        out
    }
}

fn median(ratios: &[f32]) -> f32 {
    let mut sorted = ratios.to_vec();
    sorted.sort_by(f32::total_cmp);
    sorted[sorted.len() / 2]
}

fn campaign(seeds: std::ops::Range<u64>) -> Found {
    let next = AtomicU64::new(seeds.start);
    let all = Mutex::new(Found::default());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                let mut own = Found::default();
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= seeds.end {
                        break;
                    }
                    own.run(seed);
                }
                all.lock().unwrap().add(own);
            });
        }
    });
    let mut found = all.into_inner().unwrap();
    println!("{}", found.table());
    for line in found.beyond.iter().take(5) {
        println!("{line}");
    }
    assert!(found.beyond.is_empty(), "{} errors beyond their bounds", found.beyond.len());
    assert!(found.refused * 20 < found.answers, "{} of {} refused", found.refused, found.answers);
    // Longer chains than this keep their median below 200: benches/README.md.
    for (links, ratios) in found.by_links.range(..=62) {
        let median = median(ratios);
        assert!(median <= 100.0, "to {links} links half of the bounds are above {median} errors");
    }
    found
}

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

#[test]
fn a_sample_of_the_campaign() {
    let found = campaign(0..1500);
    assert!(found.answers > 6000);
}

#[test]
#[ignore = "minutes to hours; see the head of this file"]
fn the_whole_campaign() {
    let first = number("LINKGRAM_SEED", 0);
    campaign(first..first + number("LINKGRAM_CAMPAIGN", 1_000_000));
}

#[test]
fn decimals_are_read_to_all_digits() {
    let off = |text: &str| (Exact::wide(decimal(text)) - Exact::decimal(text)).abs().near();
    assert!(off("-12.5e-1") <= Wide::ROUNDOFF && off("0.1") <= Wide::ROUNDOFF);
    assert!((decimal("0.1") - Wide::of(0.1)).abs().to_f64() > 1e-18);
}
