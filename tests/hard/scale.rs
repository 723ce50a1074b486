//! Long chains: they are answered as short ones are, and their sheets say what they have no room for. Scales beyond all
//! measure.

use std::time::Duration;

use serde_json::{Map, Value, json};

use linkgram::drawing::{self, Kind, Wish};
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::solve::{self, Solved};
use linkgram::{analytic, scene, sheet};

use super::Clock;
use crate::common;

/// A crank and parallelograms, one after the other.
fn chain(dyads: u32) -> scene::Scene {
    let (mut fixed, mut near, mut links) = (Map::new(), Map::new(), Map::new());
    fixed.insert("G0".to_owned(), json!([0, 0]));
    links.insert("2".to_owned(), json!({"joins": ["G0", "P0"], "length": 60}));
    for i in 1..=dyads {
        fixed.insert(format!("G{i}"), json!([120 * i, 0]));
        near.insert(format!("P{i}"), json!([120 * i, 60]));
        let joins = [format!("P{}", i - 1), format!("P{i}")];
        links.insert((2 * i + 1).to_string(), json!({"joins": joins, "length": 120}));
        links.insert(
            (2 * i + 2).to_string(),
            json!({"joins": [format!("G{i}"), format!("P{i}")], "length": 60}),
        );
    }
    let text = json!({
        "units": {"length": "mm"}, "fixed": fixed, "links": links, "near": near,
        "input": {"link": 2, "angle": 80, "omega": 1},
        "find": [format!("v(P{dyads})"), format!("omega({})", 2 * dyads + 2), format!("a(P{dyads})")],
    });
    scene::read(&text.to_string(), "chain.json").unwrap()
}

fn solved(scene: &scene::Scene) -> Solved {
    solve::solve(scene, Extent::Asked, sheet::scale::for_scene).unwrap()
}

/// Eight results are swept back from at once; each is told what it is told alone, to the last bit.
#[test]
fn bounds_of_many_results_are_those_of_each() {
    let solved = solved(&chain(20));
    let mut tape = solved.solution.tape.clone();
    let slots: Vec<u32> = tape.strokes().iter().flat_map(|stroke| stroke.slots).collect();
    assert!(slots.len() > 100);
    let together = tape.judged(&slots);
    for (slot, judged) in slots.into_iter().zip(together) {
        assert_eq!(judged.bound.to_bits(), tape.bound(slot).to_bits(), "slot {slot}");
        assert_eq!(judged.weakness, tape.weakness(slot), "slot {slot}");
    }
}

/// The independent solver goes from group to group: the last of four hundred links is found as well as the first. (What
/// it costs is in the benches.)
#[test]
fn the_independent_solver_is_right_at_the_end_of_a_long_chain() {
    let scene = chain(200);
    let asked: Vec<_> = scene.mechanism.asked.iter().map(|asked| asked.quantity).collect();
    let state = analytic::solve_for(&scene.mechanism, &asked).unwrap();
    // Parallelograms: every pin moves as the crank's.
    let (x, y) = (-0.06 * libm::sin(80_f64.to_radians()), 0.06 * libm::cos(80_f64.to_radians()));
    let answer = state.answer(&asked[0]);
    let Answer::Vector { value, bound } = answer else { panic!("{answer:?}") };
    assert!(libm::hypot(value[0] - x, value[1] - y) <= bound && bound < 1e-9, "{value:?} within {bound}");
}

/// Two hundred links on a page: what has no room for its name is told, on the page and in the description.
#[test]
fn a_sheet_of_two_hundred_links_says_what_it_has_no_room_for() {
    let scene = chain(99);
    let clock = Clock::start();
    let figure =
        drawing::figure(&scene, &Wish::default()).unwrap_or_else(|error| panic!("{}", error.told(&scene)));
    let took = clock.elapsed();
    assert!(took < Duration::from_secs(120), "{took:?}");
    let said = "At this size there is no room for the names of ";
    assert!(figure.description.contains(said), "{}", figure.description);
    let svg = linkgram::render::svg::write(&figure);
    assert!(svg.contains("data-unnamed=\"") && svg.contains("–P99"), "no names are told");
}

/// A scale that is stated by mistake makes a diagram of any size: it is refused before a line is lettered.
#[test]
fn absurd_scales_are_refused_before_anything_is_laid_out() {
    for (dimension, scale) in [
        ("velocity", "1e-50 m/s per cm"),
        ("velocity", "1e-9 cm/s per cm"),
        ("acceleration", "1e-20 m/s^2 per mm"),
        ("length", "1000000:1"),
    ] {
        let mut text: Value = serde_json::from_str(&common::example_text("s000-ch3a-1")).unwrap();
        text["sheet"] = json!({"scales": {dimension: scale}});
        let scene = scene::read(&text.to_string(), "scales.json").unwrap();
        for kind in Kind::ALL {
            let clock = Clock::start();
            let drawn = drawing::figure(&scene, &Wish { kind, ..Wish::default() });
            assert!(
                clock.elapsed() < Duration::from_secs(5),
                "{scale} as {kind:?} took {:?}",
                clock.elapsed()
            );
            // A question shows no diagram but the skeleton.
            if kind == Kind::Question && dimension != "length" {
                assert!(drawn.is_ok(), "{scale} as {kind:?}");
                continue;
            }
            let told = drawn.unwrap_err().told(&scene);
            assert!(told.contains("at the stated scales a diagram would be "), "{told}");
        }
    }
}
