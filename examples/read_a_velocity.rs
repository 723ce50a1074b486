//! Solves a scene and tells every answer with its bound: `cargo run --example read_a_velocity examples/s000-ch3a-1.json`.

use std::error::Error;

use linkgram::mechanism::quantity::Answer;
use linkgram::{check, scene, solve};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("which scene?")?;
    let scene = scene::read(&std::fs::read_to_string(&file)?, &file)?;
    let solved = solve::solve_numbers(&scene, solve::Settings::default())?;
    for (asked, reading) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
        let unit = &asked.unit;
        match &reading.answer {
            Answer::Scalar { value, bound } => {
                println!(
                    "{} = {} {} (within {:.1e})",
                    asked.name,
                    value / unit.si,
                    unit.symbol,
                    bound / unit.si
                );
            }
            Answer::Vector { value: [x, y], bound } => {
                let (x, y) = (x / unit.si, y / unit.si);
                println!("{} = ({x}, {y}) {} (within {:.1e})", asked.name, unit.symbol, bound / unit.si);
            }
            Answer::AtInfinity { direction: [x, y], .. } => {
                println!("{} is at infinity, along ({x}, {y})", asked.name)
            }
            Answer::Indeterminate(why) => println!("{}: {why}", asked.name),
        }
    }
    let agreement = check::agreement(&scene, &solved, &solve::solve_analytically(&scene));
    println!("the independent solver {}", if agreement.ok() { "agrees" } else { "does not agree" });
    Ok(())
}
