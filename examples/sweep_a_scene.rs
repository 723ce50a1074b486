//! Sweeps a scene over its input and tells what happens on the way, its strokes and a table:
//! `cargo run --example sweep_a_scene examples/s000-ch3a-1.json`.

use std::error::Error;

use linkgram::scene;
use linkgram::sweep::Sweep;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("which scene?")?;
    let scene = scene::read(&std::fs::read_to_string(&file)?, &file)?;
    let sweep = Sweep::new(&scene.mechanism, None)?;
    for event in &sweep.events {
        println!("at {:.6}: {:?}", event.at, event.kind);
    }
    for stroke in sweep.strokes() {
        let column = sweep.columns[stroke.column].name();
        println!("{column}: stroke {:.6}, time ratio {:.4}", stroke.length, stroke.time_ratio);
    }
    let names: Vec<String> = sweep.columns.iter().map(|column| column.name()).collect();
    println!("input, {}", names.join(", "));
    for position in sweep.positions(&sweep.equal_steps(12)) {
        let values = position
            .values
            .iter()
            .map(|value| value.map_or(String::from("-"), |value| format!("{value:.6}")));
        println!("{:.6}, {}", position.at, values.collect::<Vec<_>>().join(", "));
    }
    Ok(())
}
