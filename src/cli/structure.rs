//! `linkgram structure`.

use std::fmt::Write;
use std::path::PathBuf;

use serde_json::{Value, json};

use super::{Ending, Failure, print, read_scene};
use crate::mechanism::PointId;
use crate::mechanism::report::{DeadPosition, FourBar, InLine, Report, report};
use crate::mechanism::slider_crank::SliderCrank;
use crate::plan::Extent;
use crate::report::short;
use crate::scene::Scene;

/// What is to be reported.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The scene file; - for standard input
    pub(super) scene: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let (file, mut scene) = read_scene(&job.scene)?;
    let places = pose(&mut scene);
    let report = report(&scene.mechanism, &|point: PointId| places.get(point.0).copied().flatten());
    let text = if job.json {
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
    let of_no_page = |_: &Scene, extents: crate::graphical::Extents| extents.filling(100.0);
    let Ok(solved) = crate::solve::solve(scene, Extent::WholeSkeleton, of_no_page) else {
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
    for slider_crank in &report.slider_cranks {
        write_slider_crank(&mut out, scene, slider_crank);
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
    let [driver, coupler, output] = four_bar.links;
    for dead in &four_bar.dead {
        write_dead(out, [driver, coupler, output], dead);
    }
}

fn write_dead(out: &mut String, links: [u32; 3], dead: &DeadPosition) {
    let [crank, rod, _] = links;
    let how = match (dead.links, dead.extended) {
        (InLine::CouplerSquareToGuide, _) => format!("link {rod} square to the guide"),
        (_, true) => format!("links {} in line, stretched", numbers(&in_line(links, dead))),
        (_, false) => format!("links {} in line, folded", numbers(&in_line(links, dead))),
    };
    let _ = writeln!(
        out,
        "  {how}: link {crank} at {} deg, {} deg from here",
        degrees(dead.angle),
        degrees(dead.turn)
    );
}

fn write_slider_crank(out: &mut String, scene: &Scene, slider_crank: &SliderCrank) {
    let unit = &scene.units.length;
    let [crank, rod, offset] = slider_crank.lengths.map(|l| short(l / unit.si));
    let [o, a, b] = &slider_crank.joints;
    let [first, second] = slider_crank.links;
    let driven = if slider_crank.from_slider { ", driven by the slider" } else { "" };
    let symbol = &unit.symbol;
    let _ = writeln!(out, "slider-crank {o}-{a}-{b}{driven}");
    let _ =
        writeln!(out, "  link {first} {crank}, link {second} {rod}, offset of the guide {offset} {symbol}");
    if let (Some(transmission), Some(pressure)) = (slider_crank.transmission, slider_crank.pressure()) {
        let (transmission, pressure) = (degrees(transmission), degrees(pressure));
        let _ = writeln!(out, "  transmission angle {transmission} deg, pressure angle {pressure} deg");
    }
    if let Some(stroke) = slider_crank.stroke {
        let _ = writeln!(out, "  stroke {} {symbol}", short(stroke / unit.si));
    }
    for dead in &slider_crank.dead {
        write_dead(out, [first, second, 0], dead);
    }
}

fn in_line([driver, coupler, output]: [u32; 3], dead: &DeadPosition) -> Vec<u32> {
    match dead.links {
        InLine::CouplerAndOutput => vec![coupler, output],
        InLine::DriverAndCoupler => vec![driver, coupler],
        InLine::CouplerSquareToGuide => vec![coupler],
    }
}

fn dead_positions(links: [u32; 3], dead: &[DeadPosition]) -> Vec<Value> {
    let position = |d: &DeadPosition| {
        let (angle, turn) = (d.angle.to_degrees(), d.turn.to_degrees());
        match d.links {
            InLine::CouplerSquareToGuide => {
                json!({ "square_to_guide": links[1], "angle_deg": angle, "turn_deg": turn })
            }
            _ => json!({
                "in_line": in_line(links, d),
                "extended": d.extended,
                "angle_deg": angle,
                "turn_deg": turn,
            }),
        }
    };
    dead.iter().map(position).collect()
}

fn slider_crank(scene: &Scene, slider_crank: &SliderCrank) -> Value {
    let unit = &scene.units.length;
    let [crank, rod, offset] = slider_crank.lengths.map(|l| l / unit.si);
    let [first, second] = slider_crank.links;
    json!({
        "links": slider_crank.links,
        "joints": slider_crank.joints,
        "unit": unit.symbol,
        "crank": crank,
        "rod": rod,
        "offset": offset,
        "driven_by_slider": slider_crank.from_slider,
        "transmission_deg": slider_crank.transmission.map(f64::to_degrees),
        "pressure_deg": slider_crank.pressure().map(f64::to_degrees),
        "stroke": slider_crank.stroke.map(|stroke| stroke / unit.si),
        "dead_positions": dead_positions([first, second, 0], &slider_crank.dead),
    })
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
    let slider_cranks: Vec<Value> = report.slider_cranks.iter().map(|s| slider_crank(scene, s)).collect();
    let mobility = &report.mobility;
    let mut object = json!({
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
        "slider_cranks": slider_cranks,
    });
    if !scene.mechanism.forces.is_empty() {
        object["forces"] = balance(scene, report);
    }
    object
}

/// Which links are in balance of two forces and of three, and in which order the groups are balanced: from the output back.
fn balance(scene: &Scene, report: &Report) -> Value {
    let mechanism = &scene.mechanism;
    let of = |count: usize| -> Vec<u32> {
        let links = mechanism.moving().filter(|link| mechanism.forces_on(*link) == Some(count));
        links.map(|link| mechanism.link(link).number).collect()
    };
    let order: Vec<&Vec<u32>> = report.groups.iter().rev().map(|group| &group.links).collect();
    json!({ "two_force_members": of(2), "three_force_members": of(3), "order_of_balance": order })
}

fn four_bar(scene: &Scene, four_bar: &FourBar) -> Value {
    let unit = &scene.units.length;
    let [frame, driver, coupler, output] = four_bar.lengths.map(|l| l / unit.si);
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
        "dead_positions": dead_positions(four_bar.links, &four_bar.dead),
    })
}
