//! Every number of a page against the sweep: the export in Rust, the evaluator in node where that is installed.

use std::path::Path;
use std::process::Command;

use linkgram::live::{Live, LiveError};
use linkgram::sheet::Language;
use linkgram::sweep::{Event, EventKind, Over, Sweep};
use serde_json::{Value, json};

use linkgram::scene::Scene;

use crate::common::{self, scenes};

/// A centre that the circle diagram leads to only by those that are shown besides.
const PUSHED_WHEEL: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
    "links": { "2": { "joins": ["O", "A"], "length": 30 }, "3": { "joins": ["A", "C"], "length": 110 }, "4": { "joins": ["C"] } },
    "rolls": [{ "links": [1, 4], "line": { "through": [0, -40], "angle": -10 }, "centre": "C", "radius": 22 }],
    "near": { "C": [110, -30] }, "input": { "link": 2, "angle": 130, "omega": "8 rad/s cw" },
    "find": ["v(C)", "omega(3)", "omega(4)", "a(C)", "alpha(3)", "alpha(4)", "I(1,3)"] }"#;

/// Positions over the range, where `.ci/live` wants more than the suite has time for.
fn wanted() -> Option<u32> {
    std::env::var("LINKGRAM_LIVE_POSITIONS").ok().and_then(|n| n.parse().ok())
}

/// Where to look: over the range, at the scene's own place, and about every event.
fn places(sweep: &Sweep) -> Vec<f64> {
    let (count, step, events) = wanted().map_or((24, 4, 6), |count| (count, 1, usize::MAX));
    let mut all = sweep.equal_steps(count);
    all.push(sweep.start);
    // What refuses first, then what is merely extreme.
    let mut order: Vec<&Event> = sweep.events.iter().collect();
    order.sort_by_key(|e| matches!(e.kind, EventKind::Least { .. } | EventKind::Greatest { .. }));
    for event in order.into_iter().take(events) {
        all.push(event.at);
        for power in (0..13).step_by(step) {
            let by = 10_i64.pow(power);
            let bits = event.at.to_bits().cast_signed();
            for near in [bits + by, bits - by] {
                let near = f64::from_bits(near.cast_unsigned());
                if near.is_finite() {
                    all.push(near);
                }
            }
        }
    }
    all.retain(|at| sweep.stretch_at(*at).is_some());
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// The columns of the plain sweep among those of the page.
fn same_as_a_sweep(name: &str, plain: &Sweep, page: &Sweep, wrong: &mut Vec<String>) -> usize {
    let places = places(plain);
    let mut compared = 0;
    let columns: Vec<Option<usize>> = plain
        .columns
        .iter()
        .map(|c| page.columns.iter().position(|p| p.asked.quantity == c.asked.quantity && p.axis == c.axis))
        .collect();
    for (at, own) in places.iter().zip(plain.positions(&places)) {
        // A limit that only the rest of the skeleton has ends the page earlier.
        let Some(shown) = page.positions(&[*at]).into_iter().next() else { continue };
        for (index, column) in columns.iter().enumerate() {
            let column =
                column.unwrap_or_else(|| panic!("{name}: {} is not shown", plain.columns[index].name()));
            let (a, b) = (own.values[index], shown.values[column]);
            if a.map(f64::to_bits) != b.map(f64::to_bits) {
                let column = plain.columns[index].name();
                wrong.push(format!("{name} at {at}: {column} is {a:?} swept and {b:?} on the page"));
            }
            compared += 1;
        }
    }
    compared
}

#[test]
fn every_number_of_a_page_is_the_sweep_s_to_the_last_bit() {
    // A file for each scene: the browsers of `.ci/live` read them after this.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("live-exact");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let (mut cases, mut compared, mut left, mut wrong) = (0, 0, Vec::new(), Vec::new());
    let mut keep = |name: &str, live: &Live<'_>| {
        std::fs::write(folder.join(format!("{cases}.json")), serde_json::to_vec(&case(name, live)).unwrap())
            .unwrap();
        cases += 1;
        cases
    };
    let part = if wanted().is_some() { 1 } else { 7 };
    let wheels = |(index, (_, scene)): &(usize, (String, Scene))| {
        index % part == 0 || !scene.mechanism.rolls.is_empty()
    };
    let own = [("a pushed wheel".to_owned(), common::read(PUSHED_WHEEL))];
    let all = scenes().into_iter().enumerate().filter(wheels).map(|(_, named)| named);
    for (name, scene) in all.chain(own) {
        let Ok(plain) = Sweep::over(Over::Input, &scene.mechanism, None) else {
            left.push(name);
            continue;
        };
        let live = match Live::of(&scene, Over::Input, None) {
            Ok(live) => live,
            // Where nothing is determined at the scene's own position there is no sheet either.
            Err(LiveError::Unsolved(_)) => {
                left.push(name);
                continue;
            }
            Err(why) => panic!("{name} is swept, and has no page: {why}"),
        };
        compared += same_as_a_sweep(&name, &plain, live.sweep(), &mut wrong);
        // Over time, where something moves.
        if keep(&name, &live) % 5 == 0
            && let Ok(live) = Live::of(&scene, Over::Time, None)
        {
            keep(&format!("{name} over time"), &live);
        }
    }
    eprintln!("{compared} numbers of the export are the sweep's; not swept: {}", left.join(", "));
    assert!(
        wrong.is_empty(),
        "{} of {compared} differ: {}",
        wrong.len(),
        wrong[..wrong.len().min(40)].join("\n")
    );
    assert!(compared > 3000, "{compared}");
    in_node(&folder);
}

fn case(name: &str, live: &Live<'_>) -> Value {
    let positions: Vec<Value> = live
        .sweep()
        .positions(&places(live.sweep()))
        .into_iter()
        .map(|position| json!([position.at, position.values]))
        .collect();
    json!({ "name": name, "live": live.json(Language::English), "positions": positions })
}

fn in_node(folder: &Path) {
    let Ok(version) = Command::new("node").arg("--version").output() else {
        eprintln!("skipped: there is no node to run the page's evaluator in");
        return;
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let run = |turned: &[&str]| {
        let mut node = Command::new("node");
        node.arg(root.join("tests/live/exact.js")).arg(root.join("src/live/page")).arg(folder).args(turned);
        node.output().unwrap()
    };
    let told = run(&[]);
    let (out, error) = (String::from_utf8_lossy(&told.stdout), String::from_utf8_lossy(&told.stderr));
    eprintln!("node {}: {out}", String::from_utf8_lossy(&version.stdout).trim());
    assert!(told.status.success(), "{out}{error}");
    // What is turned round is noticed: an operation, a sign, a constant, a sample of the roundings, a guard.
    for turned in [
        ["return a * b - c * d;", "return a * b + c * d;"],
        ["return signs[code[step + 4]] * rootOf(a);", "return -signs[code[step + 4]] * rootOf(a);"],
        ["const S1 = -1.66666666666666324348e-01;", "const S1 = -1.66666666666666351e-01;"],
        ["const CLEAR = 8;", "const CLEAR = 80000;"],
        ["if (last & 256 && !this.isClear(to)) this.lost[to] = 1;", ""],
    ] {
        assert!(!run(&turned).status.success(), "nobody noticed {turned:?}");
    }
}
