//! `linkgram structure`.

use std::fmt::Write;
use std::path::Path;

use serde_json::{Value, json};

use super::report::short;
use super::{Ending, Failure, print, read_scene};
use crate::mechanism::PointId;
use crate::mechanism::report::{DeadPosition, FourBar, InLine, Report, report};
use crate::plan::Extent;
use crate::scene::Scene;

pub(super) fn run(path: &Path, as_json: bool) -> Result<Ending, Failure> {
    let (file, mut scene) = read_scene(path)?;
    let places = pose(&mut scene);
    let report = report(&scene.mechanism, &|point: PointId| places.get(point.0).copied().flatten());
    let text = if as_json {
        serde_json::to_string_pretty(&object(&file, &scene, &report))
            .map_err(|error| Failure(error.to_string()))?
            + "\n"
    } else {
        table(&scene, &report)
    };
    print(&text)?;
    Ok(Ending::Fine)
}

/// Every point's place off the skeleton, as far as it can be drawn.
fn pose(scene: &mut Scene) -> Vec<Option<[f64; 2]>> {
    // Nothing is asked but the skeleton.
    scene.mechanism.asked.clear();
    let Ok(solved) = crate::solve::solve(scene, Extent::WholeSkeleton, crate::sheet::scale::for_scene) else {
        return Vec::new();
    };
    let space = &solved.solution.construction.space;
    space.places.iter().map(|place| place.map(|p| [p[0], p[1]].map(|x| x * space.metres_per_mm))).collect()
}

fn numbers(links: &[u32]) -> String {
    links.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")
}

fn roman(class: usize) -> String {
    const ROMAN: [&str; 8] = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII"];
    ROMAN.get(class.wrapping_sub(1)).map_or_else(|| class.to_string(), |r| (*r).to_owned())
}

fn degrees(radians: f64) -> String {
    format!("{:.4}", radians.to_degrees())
}

fn table(scene: &Scene, report: &Report) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "links");
    for link in &report.links {
        let role = match (link.number, link.block) {
            (1, _) => ", the frame",
            (_, true) => ", a block",
            _ => "",
        };
        let _ = writeln!(out, "  {:<3} {}{role}", link.number, link.kind());
    }
    let _ = writeln!(out, "pairs");
    for pair in &report.pairs {
        let pin = pair.pin.as_deref().map_or(String::new(), |pin| format!(" {pin}"));
        let count = if pair.count > 1 { format!(", counts for {}", pair.count) } else { String::new() };
        let _ = writeln!(out, "  {}{pin}: links {}{count}", pair.kind, numbers(&pair.links));
    }
    let _ = writeln!(out, "mobility\n  {}", report.mobility);
    if !report.idle.is_empty() {
        let idle = report.idle.len();
        let _ = writeln!(
            out,
            "  idle: links {} turn without moving anything, F_d = {idle}, F - F_d = {}",
            numbers(&report.idle),
            report.mobility.freedoms - i64::try_from(idle).unwrap_or(i64::MAX)
        );
    }
    let _ = writeln!(out, "  redundant constraints, were it built in space: {}", report.redundant_in_space);
    if let Some(why) = &report.refused {
        let _ = writeln!(out, "groups\n  none: {why}");
    } else {
        let _ = writeln!(out, "groups");
        for (index, group) in report.groups.iter().enumerate() {
            let after: Vec<u32> = group.after.iter().filter_map(|g| u32::try_from(g + 1).ok()).collect();
            let after = if after.is_empty() { String::new() } else { format!(", after {}", numbers(&after)) };
            let _ = writeln!(
                out,
                "  {}. {} of links {}: class {}, order {}{after}",
                index + 1,
                group.kind,
                numbers(&group.links),
                roman(group.class),
                group.order
            );
        }
    }
    for four_bar in &report.four_bars {
        write_four_bar(&mut out, scene, four_bar);
    }
    out
}

fn write_four_bar(out: &mut String, scene: &Scene, four_bar: &FourBar) {
    let unit = &scene.units.length;
    let [frame, driver, coupler, output] = four_bar.lengths.map(|l| short(l / unit.si));
    let [o, a, b, q] = &four_bar.joints;
    let _ = writeln!(out, "four-bar {o}-{a}-{b}-{q}: {}", four_bar.class);
    let [second, third, fourth] = four_bar.links;
    let _ = writeln!(
        out,
        "  frame {frame}, link {second} {driver}, link {third} {coupler}, link {fourth} {output} {}",
        unit.symbol
    );
    if let (Some(transmission), Some(pressure)) = (four_bar.transmission, four_bar.pressure()) {
        let _ = writeln!(
            out,
            "  transmission angle {} deg, pressure angle {} deg",
            degrees(transmission),
            degrees(pressure)
        );
    }
    if let Some([least, greatest]) = four_bar.transmission_range {
        let _ = writeln!(
            out,
            "  transmission angle over a turn: {} to {} deg",
            degrees(least),
            degrees(greatest)
        );
    }
    for dead in &four_bar.dead {
        let _ = writeln!(
            out,
            "  links {} in line, {}: link {second} at {} deg, {} deg from here",
            numbers(&in_line(four_bar, dead)),
            if dead.extended { "stretched" } else { "folded" },
            degrees(dead.angle),
            degrees(dead.turn)
        );
    }
}

fn in_line(four_bar: &FourBar, dead: &DeadPosition) -> [u32; 2] {
    let [driver, coupler, output] = four_bar.links;
    match dead.links {
        InLine::CouplerAndOutput => [coupler, output],
        InLine::DriverAndCoupler => [driver, coupler],
    }
}

fn object(file: &str, scene: &Scene, report: &Report) -> Value {
    let links: Vec<Value> = report
        .links
        .iter()
        .map(|l| json!({ "number": l.number, "kind": l.kind(), "joints": l.joints, "block": l.block }))
        .collect();
    let pairs: Vec<Value> = report
        .pairs
        .iter()
        .map(|p| json!({ "kind": p.kind.to_string(), "pin": p.pin, "links": p.links, "count": p.count }))
        .collect();
    let groups: Vec<Value> = report
        .groups
        .iter()
        .map(|g| {
            json!({ "kind": g.kind, "links": g.links, "class": g.class, "order": g.order, "after": g.after })
        })
        .collect();
    let four_bars: Vec<Value> = report.four_bars.iter().map(|f| four_bar(scene, f)).collect();
    let mobility = &report.mobility;
    json!({
        "scene": scene.title.in_language("en").unwrap_or(file),
        "links": links,
        "pairs": pairs,
        "mobility": {
            "links": mobility.links,
            "turning": mobility.turning,
            "sliding": mobility.sliding,
            "rolling": mobility.rolling,
            "higher": mobility.higher,
            "freedoms": mobility.freedoms,
            "inputs": mobility.inputs,
            "formula": mobility.to_string(),
            "idle": report.idle,
            "redundant_in_space": report.redundant_in_space,
        },
        "groups": groups,
        "refused": report.refused,
        "four_bars": four_bars,
    })
}

fn four_bar(scene: &Scene, four_bar: &FourBar) -> Value {
    let unit = &scene.units.length;
    let [frame, driver, coupler, output] = four_bar.lengths.map(|l| l / unit.si);
    let dead: Vec<Value> = four_bar
        .dead
        .iter()
        .map(|d| {
            json!({
                "in_line": in_line(four_bar, d),
                "extended": d.extended,
                "angle_deg": d.angle.to_degrees(),
                "turn_deg": d.turn.to_degrees(),
            })
        })
        .collect();
    json!({
        "links": four_bar.links,
        "joints": four_bar.joints,
        "unit": unit.symbol,
        "frame": frame,
        "driver": driver,
        "coupler": coupler,
        "output": output,
        "class": four_bar.class.to_string(),
        "transmission_deg": four_bar.transmission.map(f64::to_degrees),
        "pressure_deg": four_bar.pressure().map(f64::to_degrees),
        "transmission_range_deg": four_bar.transmission_range.map(|r| r.map(f64::to_degrees)),
        "dead_positions": dead,
    })
}
