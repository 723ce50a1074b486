//! What nobody asks for changes no answer: not in either solver, and not on the sheet.

use serde_json::{Map, Value, json};

use linkgram::check::agreement;
use linkgram::drawing::{self, Wish};
use linkgram::mechanism::PointId;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::sheet;
use linkgram::solve::{self, Solved};

use crate::common;

fn solved(scene: &Scene) -> Option<Solved> {
    solve::solve(scene, Extent::Asked, sheet::scale::for_scene).ok()
}

/// The scene with two links more, from a moving point to a fixed one; nothing is asked of them.
fn with_a_dyad(text: &str, from: &str, to: &str, metres: f64) -> Scene {
    let mut scene: Map<String, Value> = serde_json::from_str(text).unwrap();
    let links = scene.get_mut("links").unwrap().as_object_mut().unwrap();
    let length = format!("{metres} m");
    links.insert("901".to_owned(), json!({"joins": [from, "Q9"], "length": length}));
    links.insert("902".to_owned(), json!({"joins": ["Q9", to], "length": length}));
    let text = Value::Object(scene).to_string();
    scene::read(&text, "dyad.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A moving point and a fixed one, whose distance the independent solver tells.
fn apart(scene: &Scene) -> Option<(String, String, f64)> {
    let state = linkgram::analytic::solve(&scene.mechanism, linkgram::mechanism::quantity::Order::Position);
    let state = state.ok()?;
    let ids = || (0..scene.mechanism.points.len()).map(PointId);
    let mechanism = &scene.mechanism;
    let fixed = ids().find(|id| mechanism.is_fixed(*id))?;
    let joint = |id: &PointId| mechanism.point(*id).links.len() > 1 && !mechanism.is_fixed(*id);
    let away = |id: PointId| {
        let [p, q] = [state.pose(id).ok()?.at, state.pose(fixed).ok()?.at];
        let distance = libm::hypot(p[0] - q[0], p[1] - q[1]);
        let name = |id: PointId| mechanism.point(id).name.clone();
        (distance > 1e-3).then(|| (name(id), name(fixed), distance))
    };
    ids().filter(joint).find_map(away)
}

fn answers(solved: &Solved) -> Vec<&Answer> {
    solved.solution.construction.answers.iter().map(|reading| &reading.answer).collect()
}

/// To every example and every kind of the catalogue a dyad is hung that is too short to close, and one that closes in
/// two ways: every bit of every answer stays, both solvers agree, and the sheet says what it does not show.
#[test]
fn a_dyad_that_nobody_asks_for_changes_no_scene() {
    let examples = common::example_paths().into_iter().map(|path| std::fs::read_to_string(path).unwrap());
    let texts: Vec<String> =
        examples.chain(linkgram::catalogue::KINDS.iter().map(|kind| kind.scene.to_owned())).collect();
    let (mut tried, mut drawn) = (0, 0);
    for (index, text) in texts.iter().enumerate() {
        let Ok(alone) = scene::read(text, "alone.json") else { continue };
        // Without questions of its own a scene asks for everything.
        let asks = serde_json::from_str::<Value>(text).unwrap().get("find").is_some();
        let (Some((from, to, distance)), Some(before), true) = (apart(&alone), solved(&alone), asks) else {
            continue;
        };
        for metres in [0.3 * distance, 0.7 * distance] {
            let scene = with_a_dyad(text, &from, &to, metres);
            let what = format!("{:?}, {from} to {to}, {metres} m", alone.title);
            let Some(after) = solved(&scene) else { panic!("{what}: no answer") };
            assert_eq!(answers(&before), answers(&after), "{what}");
            let state = solve::solve_analytically(&scene);
            let agreement = agreement(&scene, &after, &state);
            assert!(agreement.ok(), "{what}: {:?} {:?}", agreement.refused, agreement.disagreements());
            tried += 1;
            // Sheets take their time.
            if index.is_multiple_of(5) && drawing::figure(&alone, &Wish::default()).is_ok() {
                let figure = drawing::figure(&scene, &Wish::default());
                let figure = figure.unwrap_or_else(|error| panic!("{what}: {}", error.told(&scene)));
                assert!(figure.description.contains("901, 902"), "{what}: {}", figure.description);
                drawn += 1;
            }
        }
    }
    assert!(tried > 100 && drawn > 16, "{tried} tried, {drawn} drawn");
}
