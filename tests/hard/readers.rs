//! The three readers, of scenes, answers and drawings, under bytes and structure that nobody means: each text is taken or
//! refused, in a moment, with a place in it and a word that says what is wrong.

use linkgram::drawing::{self, Wish};
use linkgram::grade;
use linkgram::render;
use linkgram::scene::{self, Scene};

use super::dice::Dice;
use super::fuzz::{self, Tally, campaign_of, numbers_that_are_none, trying};
use super::mutation;
use crate::common;

/// How many texts every `cargo test` tries.
const SAMPLE: u64 = 6_000;

/// What mutations begin with.
struct Seeds {
    scenes: Vec<String>,
    /// Scenes that are answered, with their text.
    asked: Vec<(String, Scene)>,
    /// Drawings as the program itself writes them.
    sheets: Vec<String>,
}

fn seeds() -> Seeds {
    let scenes = fuzz::seeds();
    let asked = ["s000-ch3a-1", "s000-ch4-1", "eight-link"]
        .map(|stem| (common::example_text(stem), common::example(stem)));
    let sheet = |(_, scene): &(String, Scene)| {
        let figure =
            drawing::figure(scene, &Wish::default()).unwrap_or_else(|error| panic!("{}", error.told(scene)));
        let bytes = render::render(&figure, render::Format::Svg, &render::Options::default()).unwrap();
        String::from_utf8(bytes).unwrap()
    };
    let sheets = asked[..1].iter().map(sheet).collect();
    Seeds { scenes, asked: asked.into(), sheets }
}

/// One text for one reader.
fn a_reader(seeds: &Seeds) -> impl Fn(&mut Dice, &mut Tally) {
    |dice, tally| {
        let bent = |dice: &mut Dice, text: &str| {
            let mut text = text.to_owned();
            for _ in 0..=dice.below(4) {
                text = mutation::bend_text(dice, &text);
            }
            text
        };
        if dice.below(2) == 0 {
            let from = dice.pick(&seeds.scenes).clone();
            let text = if dice.below(3) == 0 { bent(dice, &from) } else { mutation::scene(dice, &from) };
            trying(&text);
            let lines = text.split('\n').count();
            match scene::read(&text, "s.json") {
                Ok(_) => tally.taken[0] += 1,
                Err(error) => {
                    tally.taken[1] += 1;
                    let placed =
                        (1..=lines).contains(&error.line) && error.column >= 1 && !error.what.is_empty();
                    assert!(placed, "{error}");
                    numbers_that_are_none("a refusal", &error.to_string(), &text);
                }
            }
            return;
        }
        let (scene_text, scene) = dice.pick(&seeds.asked);
        let text = match dice.below(8) {
            0..=2 => mutation::answers(dice, scene_text),
            3 => {
                let from = mutation::answers(dice, scene_text);
                bent(dice, &from)
            }
            4 | 5 => mutation::drawing(dice, scene_text),
            6 => {
                let from = mutation::drawing(dice, scene_text);
                bent(dice, &from)
            }
            _ => {
                let from = dice.pick(&seeds.sheets).clone();
                bent(dice, &from)
            }
        };
        trying(&text);
        match grade::read_answers(&text, scene) {
            Ok(_) => tally.taken[0] += 1,
            Err(error) => {
                tally.taken[1] += 1;
                let told = error.to_string();
                assert!(!told.is_empty());
                numbers_that_are_none("a refusal", &told, &text);
            }
        }
    }
}

#[test]
fn a_sample_of_texts_for_the_readers() {
    let (tally, failures) = fuzz::run((SAMPLE, 3), fuzz::PATIENT, None, &a_reader(&seeds()));
    assert!(failures.is_empty(), "{} failures, the first: {}", failures.len(), failures[0]);
    assert!(tally.taken.iter().all(|count| *count > SAMPLE / 10), "{tally:?}");
}

#[test]
#[ignore = "a campaign: as long as one wishes"]
fn campaign() {
    campaign_of(&a_reader(&seeds()));
}
