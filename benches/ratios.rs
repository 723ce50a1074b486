//! Speed in ratios, all in one run on one core: the engine beside closed forms that a programmer would write
//! for just this mechanism, one arithmetic beside another, a long chain beside a short one.
//!
//! `cargo bench --no-default-features` prints the tables of `benches/README.md`. With `--engine N FILE` it
//! solves the four-bar of the comparison with other programs instead, N positions, and writes 12 doubles for
//! each (A and B: place, velocity, acceleration).

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use linkgram::board::Variable;
use linkgram::graphical::transcribe;
use linkgram::mechanism::structure::Structure;
use linkgram::mechanism::{Given, Input, Mechanism};
use linkgram::plan::{Extent, Plan};
use linkgram::scene::Scene;
use linkgram::solve::{Arithmetic, Settings};
use linkgram::sweep::Sweep;

/// Positions in one measured pass.
const POSITIONS: u32 = 3600;
/// Passes; the median is told, and the tenth and ninetieth of a hundred.
const PASSES: usize = 101;

/// Nanoseconds: median, and the tenth and the ninetieth of a hundred passes.
#[derive(Clone, Copy)]
struct Time {
    median: f64,
    low: f64,
    high: f64,
}

fn time(per: f64, mut pass: impl FnMut()) -> Time {
    pass();
    let mut all: Vec<f64> = (0..PASSES)
        .map(|_| {
            let start = Instant::now();
            pass();
            start.elapsed().as_secs_f64() * 1e9 / per
        })
        .collect();
    all.sort_by(f64::total_cmp);
    Time { median: all[PASSES / 2], low: all[PASSES / 10], high: all[PASSES * 9 / 10] }
}

fn row(name: &str, time: Time, floor: Option<Time>) {
    let ratio = floor.map_or(String::new(), |f| format!("{:8.2}", time.median / f.median));
    println!("| {name:52} | {:10.1} | {:9.1} - {:9.1} | {ratio:>8} |", time.median, time.low, time.high);
}

fn heading(name: &str, what: &str) {
    println!("\n| {name:52} | {what:>10} | {:21} | {:>8} |", "10 to 90 of 100", "ratio");
    println!("|{0}|{1}|{2}|{3}|", "-".repeat(54), "-".repeat(12), "-".repeat(23), "-".repeat(10));
}

fn read(text: &str) -> Scene {
    match linkgram::scene::read(text, "bench") {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

fn example(stem: &str) -> Scene {
    let path = format!("{}/examples/{stem}.json", env!("CARGO_MANIFEST_DIR"));
    match std::fs::read_to_string(&path) {
        Ok(text) => read(&text),
        Err(error) => panic!("{path}: {error}"),
    }
}

/// The four-bar of the comparison with other programs.
fn four_bar(find: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [180, 0] }},
             "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }},
                        "3": {{ "joins": ["A", "B"], "length": 140 }},
                        "4": {{ "joins": ["O4", "B"], "length": 120 }} }},
             "near": {{ "B": [100, 120] }}, "input": {{ "link": 2, "angle": 30, "omega": 10, "alpha": 5 }},
             "find": {find} }}"#
    ))
}

const PLACES: &str = r#"["x(A)", "x(B)"]"#;
const VELOCITIES: &str = r#"["x(A)", "x(B)", "v(A)", "v(B)"]"#;
const ACCELERATIONS: &str = r#"["x(A)", "x(B)", "v(A)", "v(B)", "a(A)", "a(B)"]"#;

fn angles() -> Vec<f64> {
    (0..POSITIONS).map(|i| 2.0 * PI * f64::from(i) / f64::from(POSITIONS)).collect()
}

/// One position of the sweep, in nanoseconds.
fn swept(mechanism: &Mechanism) -> Time {
    let sweep = match Sweep::new(mechanism, None) {
        Ok(sweep) => sweep,
        Err(error) => panic!("{error}"),
    };
    let places = angles();
    time(f64::from(POSITIONS), || {
        let mut sum = 0.0;
        sweep.run(&places, |_, values| sum += values[values.len() - 1]);
        black_box(sum);
    })
}

/// The same with a bound for every number.
fn swept_with_bounds(mechanism: &Mechanism) -> Time {
    let places = angles();
    let sweep = match Sweep::new(mechanism, None) {
        Ok(sweep) => sweep,
        Err(error) => panic!("{error}"),
    };
    let bounded = match sweep.with_bounds() {
        Ok(bounded) => bounded,
        Err(error) => panic!("{error}"),
    };
    time(f64::from(POSITIONS), || {
        let mut sum = 0.0;
        bounded.run(&places, |_, _, bounds| sum += bounds[bounds.len() - 1]);
        black_box(sum);
    })
}

/// Bounds may cost twice the sweep without them, and as much again for each asked quantity.
fn bounds() {
    heading("positions with a bound for every number, beside without", "ns");
    let mut six = example("s000-ch3a-1");
    let all_of_six = six.mechanism.asked.len();
    let scenes = [
        ("four-bar: x, v, a of A and B", four_bar(ACCELERATIONS), 6),
        ("four-bar: v of B", four_bar(r#"["v(B)"]"#), 1),
        ("six-link 3-1: its quantities", example("s000-ch3a-1"), all_of_six),
        ("eight-link: its quantities", example("eight-link"), example("eight-link").mechanism.asked.len()),
    ];
    for (name, scene, asked) in scenes {
        let off = swept(&scene.mechanism);
        let on = swept_with_bounds(&scene.mechanism);
        row(&format!("{name}, without"), off, None);
        row(&format!("{name}, with (target {})", 2 + asked), on, Some(off));
    }
    six.mechanism.asked.truncate(1);
    let first = &six.mechanism.asked[0].name;
    let off = swept(&six.mechanism);
    row(&format!("six-link 3-1: {first}, without"), off, None);
    row(&format!("six-link 3-1: {first}, with (target 3)"), swept_with_bounds(&six.mechanism), Some(off));
}

/// What the input looks like to a closed form: angle, ω, ε.
type Rates = (f64, f64);

/// Place, velocity and acceleration of a point.
type Motion = [f64; 6];

/// A four-bar's A and B by the closed form of its loop, orders 0 to 2.
#[inline(always)]
fn four_bar_closed<const ORDER: u8>(theta: f64, (w2, e2): Rates, [r1, r2, r3, r4]: [f64; 4]) -> [Motion; 2] {
    let (s, c) = libm::sincos(theta);
    let (ax, ay) = (r2 * c, r2 * s);
    let (dx, dy) = (r1 - ax, -ay);
    let square = dx * dx + dy * dy;
    let along = (square + (r3 * r3 - r4 * r4)) / (2.0 * square);
    let across = (r3 * r3 / square - along * along).sqrt();
    let (px, py) = (dx * along - dy * across, dy * along + dx * across);
    let (bx, by) = (ax + px, ay + py);
    let mut a = [ax, ay, 0.0, 0.0, 0.0, 0.0];
    let mut b = [bx, by, 0.0, 0.0, 0.0, 0.0];
    if ORDER > 0 {
        let (qx, qy) = (bx - r1, by);
        let inverse = 1.0 / (px * qy - py * qx);
        let w3 = w2 * (qx * ay - qy * ax) * inverse;
        let w4 = w2 * (px * ay - py * ax) * inverse;
        (a[2], a[3]) = (-w2 * ay, w2 * ax);
        (b[2], b[3]) = (-w4 * qy, w4 * qx);
        if ORDER > 1 {
            let (sx, sy) = (
                w2 * w2 * ax + e2 * ay + w3 * w3 * px - w4 * w4 * qx,
                w2 * w2 * ay - e2 * ax + w3 * w3 * py - w4 * w4 * qy,
            );
            let e4 = (px * sx + py * sy) * inverse;
            (a[4], a[5]) = (-e2 * ay - w2 * w2 * ax, e2 * ax - w2 * w2 * ay);
            (b[4], b[5]) = (-e4 * qy - w4 * w4 * qx, e4 * qx - w4 * w4 * qy);
        }
    }
    [a, b]
}

/// A rod of length `r` from a moving point C to a pin D on the horizontal y = h, on the left of C or right.
#[inline(always)]
fn rod_closed(c: Motion, r: f64, h: f64, side: f64) -> (f64, f64) {
    let dy = h - c[1];
    let dx = side * (r * r - dy * dy).sqrt();
    let w = -c[3] / dx;
    let vx = c[2] - w * dy;
    let e = (w * w * dy - c[5]) / dx;
    (vx, c[4] - e * dy - w * w * dx)
}

fn closed(pass: impl Fn(f64) -> f64) -> Time {
    let places = angles();
    time(f64::from(POSITIONS), || {
        let mut sum = 0.0;
        for &at in &places {
            sum += pass(black_box(at));
        }
        black_box(sum);
    })
}

fn sweeps() {
    heading("position by position, one core", "ns");
    let lengths = [0.18, 0.06, 0.14, 0.12];
    let all = |[a, b]: [Motion; 2]| a.iter().chain(&b).sum::<f64>();
    let floors = [
        closed(|t| all(four_bar_closed::<0>(t, (10.0, 5.0), lengths))),
        closed(|t| all(four_bar_closed::<1>(t, (10.0, 5.0), lengths))),
        closed(|t| all(four_bar_closed::<2>(t, (10.0, 5.0), lengths))),
    ];
    let names = ["places", "places, velocities", "places, velocities, accelerations"];
    for ((name, find), floor) in names.into_iter().zip([PLACES, VELOCITIES, ACCELERATIONS]).zip(floors) {
        row(&format!("four-bar, closed form: {name}"), floor, None);
        row(&format!("four-bar, sweep: {name}"), swept(&four_bar(find).mechanism), Some(floor));
    }
    // Problem 3-1: four-bar with its frame turned, C opposite to B on the rocker, rod and slider.
    let (ground, turn) = (libm::hypot(0.45, 0.15), libm::atan2(0.15, 0.45));
    let (sin, cos) = libm::sincos(turn);
    let floor = closed(|t| {
        let [a, b] = four_bar_closed::<2>(t - turn, (-10.0, 0.0), [ground, 0.15, 0.45, 0.3]);
        // Back into the frame of the scene; C lies opposite to B.
        let back = |x: f64, y: f64| (cos * x - sin * y, sin * x + cos * y);
        let (bx, by) = back(b[0] - ground, b[1]);
        let ((vx, vy), (ax, ay)) = (back(b[2], b[3]), back(b[4], b[5]));
        let c = [0.45 - bx, 0.15 - by, -vx, -vy, -ax, -ay];
        let (v, acc) = rod_closed(c, 0.37, 0.37, -1.0);
        a[4] + b[4] + v + acc
    });
    row("six-link 3-1, closed form: v and a of A, B, C, D", floor, None);
    let mut six = example("s000-ch3a-1");
    six.mechanism.asked.retain(|a| {
        ["v(A)", "v(B)", "v(C)", "v(D)", "a(A)", "a(B)", "a(C)", "a(D)"].contains(&a.name.as_str())
    });
    row("six-link 3-1, sweep: v and a of A, B, C, D", swept(&six.mechanism), Some(floor));
    row(
        "six-link 3-1, sweep: all 26 quantities of the scene",
        swept(&example("s000-ch3a-1").mechanism),
        None,
    );
    row("slotted lever (4-1), sweep: its quantities", swept(&example("s000-ch4-1").mechanism), None);
    row("eight-link, sweep: its quantities", swept(&example("eight-link").mechanism), None);
}

/// A crank and so many dyads one after the other, each between the last pin and a fixed one: parallelograms.
fn chain(dyads: usize) -> Scene {
    let (mut fixed, mut links, mut near) = (String::new(), String::new(), String::new());
    for i in 1..=dyads {
        let x = 120.0 * i as f64;
        let _ = write!(fixed, r#", "G{i}": [{x}, 0]"#);
        let (two, three) = (2 * i + 1, 2 * i + 2);
        let _ = write!(links, r#", "{two}": {{ "joins": ["P{}", "P{i}"], "length": 120 }}"#, i - 1);
        let _ = write!(links, r#", "{three}": {{ "joins": ["G{i}", "P{i}"], "length": 60 }}"#);
        let _ = write!(near, r#"{}"P{i}": [{x}, 60]"#, if i > 1 { ", " } else { "" });
    }
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "G0": [0, 0]{fixed} }},
             "links": {{ "2": {{ "joins": ["G0", "P0"], "length": 60 }}{links} }},
             "near": {{ {near} }}, "input": {{ "link": 2, "angle": 90, "omega": 1 }},
             "find": ["v(P{dyads})", "a(P{dyads})"] }}"#
    ))
}

fn solve(scene: &Scene, arithmetic: Arithmetic) {
    let settings = Settings { arithmetic, ..Settings::default() };
    black_box(linkgram::solve::solve_numbers(scene, settings).is_ok());
}

fn arithmetics() {
    heading("one scene solved with bounds, by arithmetic", "us");
    for (name, scene) in [("four-bar", four_bar(ACCELERATIONS)), ("six-link 3-1", example("s000-ch3a-1"))] {
        let measure = |arithmetic| time(1000.0, || solve(&scene, arithmetic));
        let double = measure(Arithmetic::Double);
        row(&format!("{name}, f64"), double, None);
        row(&format!("{name}, f32"), measure(Arithmetic::Single), Some(double));
        row(&format!("{name}, dd"), measure(Arithmetic::DoubleDouble), Some(double));
    }
}

/// A slider-crank with a heavy rod and piston; `pins` and `slide` say what rubs.
fn loaded_crank(pins: &str, slide: &str, find: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
             "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }},
                        "3": {{ "joins": ["A", "B"], "length": 220 }} }},
             "slides": [ {{ "pin": "B", "block": 4, {slide} "on": {{ "link": 1, "through": "O2" }} }} ],
             "near": {{ "B": [240, 0] }}, "input": {{ "link": 2, "angle": 50, "omega": 100 }},
             "pins": {{ {pins} }},
             "masses": {{ "3": {{ "mass": 1.2, "inertia": 0.008, "at": [70, 0] }}, "4": {{ "mass": 0.9 }} }},
             "loads": [ {{ "on": 4, "force": 1500, "direction": "against" }} ], "find": {find} }}"#
    ))
}

/// The four-bar with mass and inertia in its coupler and rocker, and a couple on the rocker.
fn loaded_four_bar(find: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [180, 0] }},
             "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }},
                        "3": {{ "joins": ["A", "B"], "length": 140 }},
                        "4": {{ "joins": ["O4", "B"], "length": 120 }} }},
             "near": {{ "B": [100, 120] }}, "input": {{ "link": 2, "angle": 30, "omega": 10, "alpha": 5 }},
             "masses": {{ "3": {{ "mass": 1.5, "inertia": 0.004, "at": [60, 10] }},
                         "4": {{ "mass": 2, "inertia": 0.006, "at": [50, 5] }} }},
             "loads": [ {{ "on": 4, "torque": "20 N*m cw" }} ], "find": {find} }}"#
    ))
}

/// Forces: position by position, with bounds, and over a cycle.
fn forces() {
    heading("T(2), position by position", "ns");
    let torque = r#"["T(2)"]"#;
    row("four-bar with inertia (target 300)", swept(&loaded_four_bar(torque).mechanism), None);
    row("slider-crank with inertia (target 300)", swept(&loaded_crank("", "", torque).mechanism), None);
    let pins = r#""A": { "radius": 18, "f": 0.08 }, "B": { "radius": 12, "f": 0.08 }"#;
    let rubs = loaded_crank(pins, r#""f": 0.1,"#, torque);
    row("slider-crank, three pairs rub (target 3000)", swept(&rubs.mechanism), None);

    heading("solved once with bounds, beside accelerations", "us");
    let accelerations = r#"["a(A)", "a(B)", "alpha(3)", "alpha(4)"]"#;
    let pairs = r#"["T(2)", "F(1,2)", "F(2,3)", "F(3,4)", "F(1,4)"]"#;
    let of_crank = r#"["a(A)", "a(B)", "alpha(3)"]"#;
    for (name, motion, forces) in [
        ("four-bar", loaded_four_bar(accelerations), loaded_four_bar(pairs)),
        ("slider-crank", loaded_crank("", "", of_crank), loaded_crank("", "", pairs)),
    ] {
        let measure = |scene: &Scene| time(1000.0, || solve(scene, Arithmetic::Double));
        let floor = measure(&motion);
        row(&format!("{name}: accelerations"), floor, None);
        row(&format!("{name}: T(2) and every F (target 3)"), measure(&forces), Some(floor));
    }

    heading("a turning-moment diagram with its flywheel", "us");
    let mut engine = example("forces/gas-engine");
    engine.mechanism.asked.retain(|asked| ["Tmean", "Ef", "If"].contains(&asked.name.as_str()));
    let cycle = r#"["Tmean", "Ef", "If"], "cycle": { "load": { "of": 2 }, "fluctuation": 0.02 }"#;
    for (name, scene) in [
        ("slider-crank, one turn (target 20000)", loaded_crank("", "", cycle)),
        ("gas engine, two turns (target 20000)", engine),
    ] {
        row(name, time(1000.0, || solve(&scene, Arithmetic::Double)), None);
    }
}

fn lengths() {
    heading("chains of dyads: one position, per link", "ns");
    let mut first = None;
    for dyads in [1, 4, 24, 99] {
        let scene = chain(dyads);
        let links = 2 * dyads + 2;
        let m = &scene.mechanism;
        let structure = match Structure::of(m) {
            Ok(structure) => structure,
            Err(error) => panic!("{error}"),
        };
        let plan = Plan::new(m, &structure, Extent::Asked);
        let program = match transcribe(m, &structure, &plan, (Variable::Input(0), m.asked.len()), &[]) {
            Ok(transcribed) => transcribed.lean,
            Err(error) => panic!("{error}"),
        };
        let signs = vec![1.0; program.chord_count()];
        let mut block = program.block();
        let lanes = linkgram::board::LANES;
        let rounds = 200;
        let inputs = [PI / 2.0; linkgram::board::LANES];
        let t = time((rounds * lanes * links) as f64, || {
            for _ in 0..rounds {
                program.run(black_box(&inputs), &signs, &mut block);
            }
        });
        row(&format!("{links} links, {} operations", program.len()), t, first);
        first = first.or(Some(t));
    }
    heading("chains of dyads: transcribed and solved with bounds, per link", "us");
    let mut first = None;
    for dyads in [1, 4, 24, 99] {
        let scene = chain(dyads);
        let links = 2 * dyads + 2;
        let t = time(1000.0 * links as f64, || solve(&scene, Arithmetic::Double));
        row(&format!("{links} links"), t, first);
        first = first.or(Some(t));
    }
}

/// The best of a few runs: they take too long for a hundred.
fn least(mut run: impl FnMut()) -> f64 {
    let times = (0..5).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}

/// How the whole of a command grows with the links; an exponent of 1 is a fixed cost for each link.
fn growth() {
    let table = |what: &str, sizes: [usize; 4], run: &dyn Fn(&Scene)| {
        println!("\n| {what} | s | us a link | exponent |\n|---|---|---|---|");
        let mut before: Option<(f64, f64)> = None;
        for links in sizes {
            let scene = chain((links - 2) / 2);
            let (took, size) = (least(|| run(&scene)), links as f64);
            let exponent = before.map_or(String::new(), |(last, of)| {
                format!("{:.2}", libm::log(took / last) / libm::log(size / of))
            });
            println!("| {links} links | {took:.4} | {:.1} | {exponent} |", 1e6 * took / size);
            before = Some((took, size));
        }
    };
    table("two quantities, both solvers", [200, 1000, 2000, 5000], &|scene| {
        solve(scene, Arithmetic::Double);
        if let Ok(state) = linkgram::solve::solve_analytically(scene) {
            for asked in &scene.mechanism.asked {
                black_box(state.answer(&asked.quantity));
            }
        }
    });
    table("a sheet, confirmed", [8, 32, 100, 200], &|scene| {
        black_box(linkgram::drawing::figure(scene, &linkgram::drawing::Wish::default()).is_ok());
    });
}

fn whole_way() {
    heading("the whole way, in this process", "us");
    let path = format!("{}/examples/s000-ch3a-1.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap_or_default();
    row("read the scene 3-1", time(1000.0, || drop(black_box(read(&text)))), None);
    let scene = read(&text);
    let check = time(1000.0, || drop(black_box(linkgram::check::check(&scene, 0.05))));
    row("check 3-1 (both solvers, 26 quantities)", check, None);
    let bar = four_bar(r#"["omega(3)", "omega(4)"]"#);
    let check = time(1000.0, || drop(black_box(linkgram::check::check(&bar, 0.05))));
    row("check a four-bar (two quantities)", check, None);
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, linkgram::sheet::scale::for_scene);
    if let Ok(solved) = solved {
        let sheet = time(1000.0, || {
            let figure = linkgram::sheet::solution(
                &scene,
                &solved.solution.construction,
                linkgram::sheet::Language::default(),
            );
            black_box(linkgram::render::svg::write(&figure).len());
        });
        row("sheet of 3-1 as SVG", sheet, None);
    }
}

/// `--engine N FILE`: for the script that compares programs.
fn engine(positions: u32, file: &str) -> std::io::Result<()> {
    let mut scene = four_bar(ACCELERATIONS);
    if let Input::Angle { angle, .. } = &mut scene.mechanism.inputs[0] {
        *angle = Some(Given::exact(PI / 6.0));
    }
    let sweep = match Sweep::new(&scene.mechanism, None) {
        Ok(sweep) => sweep,
        Err(error) => panic!("{error}"),
    };
    let places: Vec<f64> = (0..positions).map(|i| 2.0 * PI * f64::from(i) / f64::from(positions)).collect();
    let mut rows = vec![[0.0_f64; 12]; places.len()];
    let mut best = f64::INFINITY;
    for _ in 0..15 {
        let start = Instant::now();
        let mut next = rows.iter_mut();
        sweep.run(&places, |_, values| {
            if let Some(row) = next.next() {
                row.copy_from_slice(&values[..12]);
            }
        });
        best = best.min(start.elapsed().as_secs_f64());
    }
    let bytes: Vec<u8> = rows.iter().flatten().flat_map(|x| (x * 1000.0).to_le_bytes()).collect();
    std::fs::write(file, bytes)?;
    println!("seconds={best}");
    Ok(())
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, flag, positions, file, ..] = arguments.as_slice()
        && flag == "--engine"
    {
        return engine(positions.parse().unwrap_or(360), file);
    }
    sweeps();
    bounds();
    arithmetics();
    forces();
    lengths();
    growth();
    whole_way();
    Ok(())
}
