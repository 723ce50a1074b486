//! Draws a scene as question and as solution: `cargo run --example draw_a_sheet examples/s000-ch3a-1.json` writes
//! `question.svg` and `solution.svg` into the present folder.

use std::error::Error;

use linkgram::drawing::{self, Kind, Wish};
use linkgram::render::{Format, Options, render};
use linkgram::scene;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("which scene?")?;
    let scene = scene::read(&std::fs::read_to_string(&file)?, &file)?;
    for kind in [Kind::Question, Kind::Solution] {
        let wish = Wish { kind, ..Wish::default() };
        // The error knows its place in the file.
        let figure = drawing::figure(&scene, &wish).map_err(|error| error.told(&scene))?;
        let svg = render(&figure, Format::Svg, &Options::default())?;
        std::fs::write(format!("{}.svg", kind.name()), svg)?;
    }
    Ok(())
}
