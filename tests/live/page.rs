//! The page's bytes: its policy, what strangers wrote into it, what a question keeps to itself, and how its scripts speak.

use std::fs;

use linkgram::drawing::{self, Kind, Wish};
use linkgram::live::{self, Live, Options};
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::{self, Language};
use linkgram::solve::{self, Solved};
use linkgram::sweep::Over;
use serde_json::Value;

use crate::common;

fn solved(scene: &Scene) -> Solved {
    solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap()
}

fn options(scene: &Scene, kind: Kind) -> Options {
    let wish = Wish { kind, ..Wish::default() };
    Options { sheets: vec![(Language::English, drawing::figure(scene, &wish).unwrap())], seconds: 6.0 }
}

fn kind(name: &str) -> &'static str {
    linkgram::catalogue::KINDS.iter().find(|kind| kind.name == name).unwrap().scene
}

fn between<'t>(text: &'t str, from: &str, to: &str) -> &'t str {
    text.split_once(from).unwrap().1.split_once(to).unwrap().0
}

#[test]
fn a_page_holds_one_script_and_what_strangers_wrote_is_text() {
    let text = kind("slider-crank");
    let hostile = "</script><script>alert(1)</script><!-- \" ' \u{2028} & <b>";
    let mut json: Value = serde_json::from_str(text).unwrap();
    json["title"] = Value::from(hostile);
    let scene = common::read(&json.to_string());
    let solved = solved(&scene);
    let live = Live::of_solved(&scene, &solved, Over::Input, None).unwrap();
    let (page, still) = live::page(&scene, &solved, Ok(&live), &options(&scene, Kind::Solution)).unwrap();
    assert_eq!(still, None);
    assert!(!page.contains("<script>alert") && !page.contains("<b>") && !page.contains("\u{2028}\""));
    assert_eq!(page.matches("<script").count(), 2, "the data and the script");
    assert_eq!(page.matches("</script>").count(), 2);
    assert_eq!(page.matches("<style").count(), 1);
    assert!(!page.contains(" style=\"") && !page.contains("http-equiv=\"refresh\""));
    // Nothing is fetched: the only addresses are names of XML.
    for part in page.split("http").skip(1) {
        assert!(
            part.starts_with("://www.w3.org/")
                || part.starts_with("s://www.w3.org/")
                || part.starts_with("-equiv"),
            "{}",
            &part[..40]
        );
    }
    let data: Value = serde_json::from_str(between(&page, "id=\"linkgram-live\">", "</script>")).unwrap();
    assert_eq!(data["texts"]["en"]["title"], Value::from(hostile));
    assert_eq!((data["format"].as_str(), data["version"].as_u64()), (Some("linkgram-live"), Some(1)));
    // The same scene, the same bytes.
    let again = live::page(&scene, &solved, Ok(&live), &options(&scene, Kind::Solution)).unwrap().0;
    assert_eq!(page, again);
    // Every group that moves is in the markup once, and what moves is not still.
    let ink = data["ink"].as_array().unwrap();
    assert!(ink.len() > 20);
    for one in ink.iter().chain(data["labels"].as_array().unwrap()) {
        let id = format!("id=\"{}\"", one["id"].as_str().unwrap());
        assert_eq!(page.matches(&id).count(), 1, "{id}");
    }
    assert!(ink.iter().all(|one| one["move"] != "still"), "all of a slider-crank's ink moves");
}

/// `sheet.live` states how the page opens; what it cannot be is refused where it stands.
#[test]
fn a_scene_states_how_its_page_opens() {
    let with = |live: Value| {
        let mut json: Value = serde_json::from_str(kind("four-bar")).unwrap();
        json["sheet"]["live"] = live;
        json.to_string()
    };
    let stated = serde_json::json!({ "play_seconds": 20, "traces": ["B"], "diagrams": ["omega(4)"], "scale": "refit",
        "panels": ["skeleton", "velocity"] });
    let scene = common::read(&with(stated));
    let solved = solved(&scene);
    let live = Live::of_solved(&scene, &solved, Over::Input, None).unwrap();
    let (page, _) = live::page(&scene, &solved, Ok(&live), &options(&scene, Kind::Solution)).unwrap();
    let data: Value = serde_json::from_str(between(&page, "id=\"linkgram-live\">", "</script>")).unwrap();
    let row = scene.mechanism.asked.iter().position(|asked| asked.name == "omega(4)").unwrap();
    assert_eq!(
        data["opens"],
        serde_json::json!({ "traces": ["B"], "diagrams": [row], "refit": true, "closed": [2] })
    );
    assert_eq!(data["seconds"], serde_json::json!(20.0));
    for (live, told) in [
        (serde_json::json!({ "traces": ["Q"] }), "there is no point `Q`"),
        (serde_json::json!({ "play_seconds": 0 }), "choose between 1 and 120 seconds"),
        (serde_json::json!({ "diagrams": ["v(A/B)"] }), "a diagram shows what is asked for"),
        (serde_json::json!({ "scale": "free" }), "`free` is not a way to choose scales"),
        (serde_json::json!({ "speed": 3 }), "speed"),
        (serde_json::json!({ "panels": ["velocitys"] }), "`velocitys` is not a panel of the page"),
    ] {
        let text = with(live.clone());
        let error = linkgram::scene::read(&text, "f").expect_err(told);
        assert!(error.to_string().contains(told), "{live}: {error}");
    }
}

#[test]
fn a_question_gives_nothing_away() {
    let scene = common::example("s000-ch3a-1");
    let solved = solved(&scene);
    let page = live::question(&scene, &options(&scene, Kind::Question));
    assert!(!page.contains("linkgram-live") && !page.contains("class Program"));
    for (asked, reading) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
        use linkgram::mechanism::quantity::Answer;
        let values = match &reading.answer {
            Answer::Scalar { value, .. } => vec![*value],
            Answer::Vector { value: [x, y], .. } => vec![*x, *y, libm::hypot(*x, *y)],
            _ => continue,
        };
        for value in values {
            let told = (value / asked.unit.si).abs();
            for figures in 3..=6_usize {
                let short = format!("{told:.*e}", figures - 1);
                let plain: f64 = short.parse().unwrap();
                let text = plain.to_string();
                // What three figures say by chance is no answer told; glyph data is not text.
                if text.len() > 4 {
                    let visible: String = page
                        .split("base64,")
                        .map(|part| part.split_once(')').map_or(part, |(_, rest)| rest))
                        .collect();
                    assert!(!visible.contains(&format!(">{text}<")), "{} = {text}", asked.name);
                }
            }
        }
    }
}

#[test]
fn no_script_knows_a_mechanism() {
    let folder = common::root().join("src/live/page");
    let words = [
        "crank",
        "coupler",
        "rocker",
        "slider-",
        "dyad",
        "four-bar",
        "gear",
        "piston",
        "cosine rule",
        "Freudenstein",
        "Rrr",
        "loop closure",
    ];
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        for word in words {
            assert!(!text.to_lowercase().contains(&word.to_lowercase()), "{}: {word}", path.display());
        }
        for forbidden in [
            "innerHTML",
            "eval(",
            "outerHTML",
            "document.write",
            "insertAdjacentHTML",
            "localStorage",
            "fetch(",
        ] {
            assert!(!text.contains(forbidden), "{}: {forbidden}", path.display());
        }
    }
}

/// What is typed into the form of a question: digits of Persian and Arabic and a decimal comma are read; what cannot be
/// read is marked, and nothing is saved without it.
#[test]
fn the_form_of_a_question_reads_or_marks() {
    let typed = serde_json::json!([
        [
            ["v(B)", "magnitude", "in/s", "۵۷٫۴"],
            ["v(B)", "direction", "deg", "−١٨٠"],
            ["omega(3)", "value", "rad/s", "3,39"],
            ["x(B)", "x", "in", "1"],
            ["x(B)", "y", "in", "۱٬۰۰۰"]
        ],
        [
            ["v(B)", "magnitude", "in/s", ""],
            ["v(B)", "direction", "deg", "10"],
            ["omega(3)", "value", "rad/s", "abc"],
            ["x(B)", "x", "in", "1"],
            ["x(B)", "y", "in", ""]
        ],
        [
            ["v(B)", "magnitude", "in/s", "-3"],
            ["a(B)", "magnitude", "in/s^2", "3 m"],
            ["omega(3)", "value", "rad/s", ""]
        ],
    ]);
    let root = common::root();
    let ran = std::process::Command::new("node")
        .arg(root.join("tests/live/question.js"))
        .args(["entry.js", "save.js", "question.js"].map(|name| root.join("src/live/page").join(name)))
        .arg(typed.to_string())
        .output();
    let Ok(ran) = ran else {
        eprintln!("skipped: there is no node to run the form in");
        return;
    };
    let told: serde_json::Value = serde_json::from_slice(&ran.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&ran.stderr)));
    assert_eq!(
        told[0]["saved"],
        serde_json::json!({ "v(B)": { "magnitude": 57.4, "unit": "in/s", "direction": -180 },
            "omega(3)": { "value": 3.39, "unit": "rad/s" }, "x(B)": { "unit": "in", "components": [1, 1000] } })
    );
    assert_eq!(told[0]["marked"], serde_json::json!([false, false, false, false, false]));
    assert_eq!(told[1]["marked"], serde_json::json!([true, false, true, false, true]));
    assert_eq!(told[2]["marked"], serde_json::json!([true, true, false]));
    assert!(told[1]["saved"] == "" && told[2]["saved"] == "");
}

#[test]
fn the_page_writes_angles_as_the_sheet_does() {
    let stated = [99.55, 12.25, 0.5, 0.125, 180.0, 179.96, 45.0, 359.9996, 30.04, 100.0, 0.0];
    let rounded = [99.552_3, 12.250_01, 33.333_333, 0.04];
    let all: Vec<f64> =
        stated.iter().chain(&rounded).flat_map(|own| [*own, -own]).map(f64::to_radians).collect();
    let page = common::root().join("src/live/page/numbers.js");
    let script = "const fs = require('fs'), degrees = new Function(`${fs.readFileSync(process.argv[1], 'utf8')}; return degrees`)();
        console.log(JSON.stringify(JSON.parse(process.argv[2]).map(degrees)));";
    let ran = std::process::Command::new("node")
        .args(["-e", script])
        .arg(page)
        .arg(serde_json::to_string(&all).unwrap())
        .output();
    let Ok(ran) = ran else {
        eprintln!("skipped: there is no node to run the page's script in");
        return;
    };
    let told: Vec<String> = serde_json::from_slice(&ran.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&ran.stderr)));
    let of_the_sheet: Vec<String> = all.iter().map(|own| sheet::moving::printed_degrees(*own)).collect();
    assert_eq!(told, of_the_sheet);
    assert_eq!(&told[1], "−99.55°");
}

#[test]
fn panels_of_a_page_are_figures_of_a_sheet() {
    let schema = linkgram::scene::schema();
    let named = schema.pointer("/$defs/live/properties/panels/items/enum");
    let panels: Vec<&str> = named.unwrap().as_array().unwrap().iter().filter_map(Value::as_str).collect();
    let figures = sheet::figure_names();
    let strange: Vec<&&str> = panels.iter().filter(|panel| !figures.contains(panel)).collect();
    assert!(strange.is_empty(), "{strange:?} of `panels` are names of no figure");
    // What does not move with the mechanism, is text, or is of forces, of which a page has none.
    let of_sheets_alone = [
        "equivalent",
        "lever",
        "results",
        "steps",
        "forces",
        "inertia",
        "loads",
        "bodies",
        "body",
        "polygons",
        "polygon",
        "shaking",
        "friction",
        "turning-moment",
        "energy",
        "controlling-force",
    ];
    let missing = figures.iter().filter(|name| !of_sheets_alone.contains(name) && !panels.contains(name));
    let missing: Vec<&&str> = missing.collect();
    assert!(missing.is_empty(), "neither in `panels` nor told to be of sheets alone: {missing:?}");
    assert_eq!(panels.len() + of_sheets_alone.len(), figures.len());
}

/// A crank and a second link that is driven at another angle.
fn two_cranks() -> Scene {
    common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O": [0, 0], "E": [160, 0] },
            "links": { "2": { "joins": ["O", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 110 },
                       "4": { "joins": ["B", "D"], "length": 90 }, "5": { "joins": ["E", "D"], "length": 30 } },
            "near": { "B": [90, 90] },
            "inputs": [{ "link": 2, "angle": 50, "omega": 3 }, { "link": 5, "angle": 60, "omega": 1 }],
            "find": ["v(B)"] }"#,
    )
}

#[test]
fn the_angle_of_a_second_input_stays_as_it_is() {
    let scene = two_cranks();
    let solved = solved(&scene);
    let live = Live::of_solved(&scene, &solved, Over::Input, None).unwrap();
    let (page, _) = live::page(&scene, &solved, Ok(&live), &options(&scene, Kind::Solution)).unwrap();
    let data: Value = serde_json::from_str(between(&page, "id=\"linkgram-live\">", "</script>")).unwrap();
    let ink = data["ink"].as_array().unwrap();
    let turned = ink.iter().filter(|ink| ink["move"] == "turn").count();
    assert_eq!(turned, 1, "only the angle that is varied opens with the input");
}

/// What a page of the scene holds; the reason why it stands still.
fn data_of(scene: &Scene) -> Result<Value, String> {
    let solved = solved(scene);
    let live = Live::of_solved(scene, &solved, Over::Input, None).unwrap();
    let (page, still) = live::page(scene, &solved, Ok(&live), &options(scene, Kind::Solution)).unwrap();
    match still {
        Some(why) => Err(why),
        None => Ok(serde_json::from_str(between(&page, "id=\"linkgram-live\">", "</script>")).unwrap()),
    }
}

/// The names of a panel, as the data of what they name call it.
fn names_in(data: &Value, panel: usize) -> Vec<String> {
    let labels = data["labels"].as_array().unwrap().iter().filter(|label| label["panel"] == panel);
    let of = |label: &Value| {
        label["of"].as_array().map(|of| of.iter().map(|name| name.as_str().unwrap().to_owned()).collect())
    };
    labels.filter_map(of).flat_map(|of: Vec<String>| of).collect()
}

/// A figure of a velocity carried over by centres, or of Klein's construction, is nothing without the names of its arrows and of
/// its centres and without its scale of velocities.
#[test]
fn what_is_drawn_over_a_skeleton_has_its_names_and_its_scale() {
    for (name, panel, wanted, scale) in [
        (
            "centres/whitworth",
            2,
            &["v(A)", "v(A@4)", "slip(A/4)", "v(C)", "(12)", "(14)", "(24)", "(26)"][..],
            "100 mm/s",
        ),
        ("centres/four-bar", 4, &["v(A)", "v(B)", "(12)", "(13)"], "100 mm/s"),
        ("centres/four-bar", 5, &["v(A)", "v(B)"], "100 mm/s"),
        // ω₂ times 1 : 2 and ω₂² times 1 : 2, by hand.
        (
            "constructions/klein",
            1,
            &["v(B)", "v(B/A)", "a(B)", "a(B/A)", "at(B/A)"],
            "628.32 mm/s\u{a0}≡\u{a0}1\u{a0}cm, 19\u{2009}739 mm/s²",
        ),
    ] {
        let data = data_of(&common::example(name)).unwrap();
        let names = names_in(&data, panel);
        for own in wanted {
            assert!(names.iter().any(|name| name == own), "{name}: no name {own} among {names:?}");
        }
        let told = data["texts"]["en"]["scales"][panel].as_str().unwrap().replace('\u{202f}', "\u{2009}");
        let plain = |text: &str| text.replace('\u{a0}', " ");
        assert!(plain(&told).contains(&plain(scale)), "{name}: {told}");
        // Every arrow has the name that stands between its ends.
        let labels = data["labels"].as_array().unwrap();
        let ink = data["ink"].as_array().unwrap().iter();
        for arrow in ink.filter(|ink| ink["panel"] == panel && ink["move"] == "arrow") {
            let own = labels.iter().filter(|label| label["panel"] == panel);
            let rounded = |at: &Value| {
                let number =
                    |x: &Value| x.as_f64().map_or_else(|| x.to_string(), |x| format!("{:.3}", x + 0.0));
                let numbers =
                    |all: &Value| all.as_array().unwrap().iter().map(number).collect::<Vec<_>>().join(" ");
                format!("{} {}", at[0], numbers(&at[1])).replace("-0.000", "0.000")
            };
            let ends = |of: &Value| of.as_array().unwrap().iter().map(rounded).collect::<Vec<_>>();
            let at = ends(&arrow["at"]);
            // One that is only turned has the name of its tip.
            let mut names = own.map(|label| ends(&label["anchors"]));
            assert!(names.any(|anchors| anchors == at || anchors == at[1..]), "{name}: {at:?} has no name");
        }
    }
}

/// A rotation's name stands by its own arrow: each hangs on the number whose sense the arrow shows.
#[test]
fn every_curved_arrow_has_its_own_name() {
    for name in ["constructions/klein", "s000-ch3a-1", "centres/four-bar"] {
        let data = data_of(&common::example(name)).unwrap();
        let (ink, labels) = (data["ink"].as_array().unwrap(), data["labels"].as_array().unwrap());
        let mut arrows: Vec<(u64, String)> = ink
            .iter()
            .filter(|ink| ink["panel"] == 0 && ink["sense"].is_array())
            .map(|ink| (ink["sense"][0].as_u64().unwrap(), ink["at"].to_string()))
            .collect();
        arrows.sort();
        arrows.dedup();
        let mut names: Vec<(u64, String)> = labels
            .iter()
            .filter(|label| label["panel"] == 0 && label["output"].is_u64())
            .map(|label| (label["output"].as_u64().unwrap(), label["anchors"][0][0].to_string()))
            .collect();
        names.sort();
        assert_eq!(arrows, names, "{name}");
        assert!(arrows.len() > 1, "{name}");
    }
    // A crank that gathers speed has both, whatever is asked.
    let data = data_of(&common::example("constructions/klein")).unwrap();
    let named =
        |wanted: &str| data["outputs"].as_array().unwrap().iter().any(|output| output["name"] == wanted);
    assert!(named("omega(2)") && named("alpha(2)"));
}

/// Of wheels that `sweep` sweeps the page moves, with every name that the sheet has: no mark of how far one has rolled takes part.
#[test]
fn wheels_that_are_swept_move() {
    let mut moved = 0;
    for kind in linkgram::catalogue::KINDS {
        let scene = common::read(kind.scene);
        if scene.mechanism.rolls.is_empty() {
            continue;
        }
        let solved = solved(&scene);
        if Live::of_solved(&scene, &solved, Over::Input, None).is_err() {
            continue;
        }
        let data = data_of(&scene).unwrap_or_else(|why| panic!("{}: {why}", kind.name));
        let names = names_in(&data, 0);
        for link in scene.mechanism.moving().filter(|link| !scene.mechanism.link(*link).block) {
            let number = scene.mechanism.link(link).number.to_string();
            assert!(names.contains(&number), "{}: link {number} has no number among {names:?}", kind.name);
        }
        assert!(!data.to_string().contains("the mark of link"), "{}", kind.name);
        moved += 1;
    }
    assert!(moved >= 6, "only {moved} kinds with wheels move");
}

#[test]
fn a_page_that_stands_still_says_why_and_not_where_its_scene_lies() {
    let scene = scene_of("rolling-wheel", "/home/author/exam/wheel.json");
    let solved = solved(&scene);
    let why = "a reason".to_owned();
    let sheets = vec![(Language::from_tag("ar").unwrap(), {
        let wish = Wish { language: Language::from_tag("ar"), ..Wish::default() };
        drawing::figure(&scene, &wish).unwrap()
    })];
    let (page, _) = live::page(&scene, &solved, Err(why), &Options { sheets, seconds: 6.0 }).unwrap();
    assert!(page.contains("<bdi lang=\"en\" dir=\"ltr\">a reason</bdi>"));
    assert!(!page.contains("/home/author"));
}

fn scene_of(name: &str, file: &str) -> Scene {
    linkgram::scene::read(kind(name), file).unwrap()
}

/// What of a page hangs on what, told by the names of outputs: lines, vectors, arrows of rotation, arcs of angles, names, and how many
/// sentences are told elsewhere than where it opens.
fn drawn_in(data: &Value) -> Vec<String> {
    let index = |value: &Value| value.as_u64().unwrap() as usize;
    let name = |output: &Value| {
        let output = &data["outputs"][index(output)];
        format!("{} {}", output["name"], output["axis"])
    };
    let place = |panel: &Value, place: &Value| -> String {
        let terms = data["panels"][index(panel)]["places"][index(place)].as_array().unwrap();
        terms.iter().map(|term| format!("{}{}", term[0], name(&term[1]))).collect::<Vec<_>>().join(" ")
    };
    let frame = |panel: &Value, frame: &Value| match frame[0].as_u64().unwrap() {
        0 => "fixed".to_owned(),
        1 => place(panel, &frame[1]),
        2 | 3 => format!("{} to {}", place(panel, &frame[1]), place(panel, &frame[2])),
        _ => format!("{} by {}", place(panel, &frame[1]), name(&frame[2])),
    };
    let mut all = Vec::new();
    for ink in data["ink"].as_array().unwrap() {
        let (panel, at) = (&ink["panel"], ink["at"].as_array().unwrap());
        let hangs = match ink["move"].as_str().unwrap() {
            "ray" | "vector" => at.iter().map(|end| place(panel, end)).collect::<Vec<_>>().join(" > "),
            "turn" => place(panel, &at[0]),
            "whole" if ink["sense"].is_array() => {
                format!("{} {} {}", frame(panel, &ink["at"]), name(&ink["sense"][0]), ink["sense"][1])
            }
            _ => continue,
        };
        all.push(format!("{panel} {} {hangs}, step {}", ink["move"], ink["step"]));
    }
    for label in data["labels"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|label| label["panel"] != 0 || label["output"].is_u64())
    {
        let anchors = label["anchors"].as_array().unwrap().iter();
        let at: Vec<String> = anchors.map(|anchor| frame(&label["panel"], &anchor[0])).collect();
        all.push(format!(
            "{} name {} at {}, step {}",
            label["panel"],
            label["of"],
            at.join(" > "),
            label["step"]
        ));
    }
    let steps = data["texts"]["en"]["steps"].as_array().unwrap();
    let sentences = steps.iter().flat_map(|step| step["sentences"].as_array().unwrap());
    let is_everywhere = |text: &&Value| {
        text.get("own").is_none() || text.get("elsewhere").is_some() || text.get("of").is_some()
    };
    all.push(format!("{} sentences", sentences.filter(is_everywhere).count()));
    all.sort();
    all
}

/// A slider-crank whose crank is at an angle, degrees.
fn slider_crank(angle: f64) -> String {
    format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "3": {{ "joins": ["A", "B"], "length": 180 }} }},
        "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }} ],
        "near": {{ "B": [200, 0] }}, "input": {{ "link": 2, "angle": {angle}, "omega": "20 rad/s" }},
        "find": ["v(B)", "a(B)", "omega(3)", "alpha(3)"] }}"#
    )
}

/// A planet of a third of its ring, which carries a rod: it has turned back by twice the angle of its arm.
fn hypocycloid(angle: f64) -> String {
    let (sin, cos) = libm::sincos(angle.to_radians());
    let (back_sin, back_cos) = libm::sincos(-2.0 * angle.to_radians());
    let b = [50.0 * cos + 20.0 * back_cos, 50.0 * sin + 20.0 * back_sin];
    format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O": [0, 0] }}, "placed": {{ "B": [{}, {}] }},
        "links": {{ "2": {{ "joins": ["O", "A"], "length": 50 }}, "3": {{ "joins": ["A", "B"], "length": 20 }},
                    "4": {{ "joins": ["B", "C"], "length": 160 }} }},
        "slides": [ {{ "pin": "C", "block": 5, "on": {{ "link": 1, "through": "O", "angle": 90 }} }} ],
        "rolls": [ {{ "links": [1, 3], "centres": ["O", "A"], "radii": [75, 25], "internal": true }} ],
        "near": {{ "C": [0, {}] }}, "input": {{ "link": 2, "angle": {angle}, "omega": "10 rad/s" }},
        "find": ["v(B)", "v(C)", "omega(3)", "omega(4)", "a(B)", "a(C)", "alpha(4)"] }}"#,
        b[0],
        b[1],
        b[1] + libm::sqrt(160.0 * 160.0 - b[0] * b[0]),
    )
}

/// A wheel that drives one of twice its size, which carries a rod: at 30° of the first the rod's pin is above the second's centre.
fn gear_pair(angle: f64) -> String {
    let (sin, cos) = libm::sincos((90.0 - (angle - 30.0) / 2.0).to_radians());
    let c = [90.0 + 40.0 * cos, 40.0 * sin];
    format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O3": [90, 0] }}, "placed": {{ "C": [{}, {}] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 20 }}, "3": {{ "joins": ["O3", "C"] }},
                    "4": {{ "joins": ["C", "D"], "length": 150 }} }},
        "slides": [ {{ "pin": "D", "block": 5, "on": {{ "link": 1, "through": [90, 20], "angle": 0 }} }} ],
        "rolls": [ {{ "links": [2, 3], "centres": ["O2", "O3"], "radii": [30, 60] }} ],
        "near": {{ "D": [240, 20] }}, "input": {{ "link": 2, "angle": {angle}, "omega": "240 rpm" }},
        "find": ["omega(3)", "v(C)", "v(D)", "omega(4)", "a(C)", "a(D)", "alpha(4)"] }}"#,
        c[0], c[1],
    )
}

/// A wheel that is pushed along a rail: at 90° the rod does not turn.
fn pushed_wheel(angle: f64) -> String {
    format!(
        r#"{{ "units": {{ "length": "cm" }}, "fixed": {{ "O": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O", "A"], "length": 5 }}, "3": {{ "joins": ["A", "C"], "length": 18 }}, "4": {{ "joins": ["C"] }} }},
        "rolls": [ {{ "links": [1, 4], "line": {{ "link": 1, "through": [0, -6], "angle": 0 }}, "centre": "C", "radius": 4 }} ],
        "near": {{ "C": [20.6, -2] }}, "input": {{ "link": 2, "angle": {angle}, "omega": "120 rpm" }},
        "find": ["v(C)", "omega(4)", "a(C)", "alpha(4)", "omega(3)"] }}"#
    )
}

fn of_catalogue(name: &str, angle: f64) -> String {
    let mut scene: Value = serde_json::from_str(kind(name)).unwrap();
    scene["input"]["angle"] = angle.into();
    scene.to_string()
}

/// What is drawn hangs on the mechanism and on what is asked, wherever a page is opened: where something is zero or falls together
/// there, all is as on the page of the same mechanism that is opened elsewhere. At 0° a crank has no tangential part in its rod and
/// its angle no arc, at 90° the rod of a central slider-crank does not turn; a slotted lever stands square to its crank's way; the
/// rod of the planet and of the wheel moves along itself.
#[test]
fn what_is_drawn_is_the_same_wherever_a_page_is_opened() {
    type Make = fn(f64) -> String;
    let all: [(&str, Make, f64, &[f64]); 6] = [
        ("slider-crank", slider_crank, 50.0, &[0.0, 90.0]),
        ("hypocycloid", hypocycloid, 40.0, &[0.0]),
        ("gear-pair", gear_pair, 75.0, &[30.0]),
        ("oldham", |angle| of_catalogue("oldham", angle), 50.0, &[90.0]),
        ("whitworth", |angle| of_catalogue("whitworth", angle), 50.0, &[90.0]),
        ("rack", pushed_wheel, 65.0, &[90.0]),
    ];
    for (name, make, usual, angles) in all {
        let at = |angle: f64| drawn_in(&data_of(&common::read(&make(angle))).unwrap());
        let elsewhere = at(usual);
        assert!(elsewhere.iter().filter(|own| own.contains("omega(")).count() >= 2, "{name}: {elsewhere:?}");
        for angle in angles {
            let own = at(*angle);
            let less = |one: &[String], other: &[String]| -> Vec<String> {
                one.iter().filter(|line| !other.contains(line)).cloned().collect()
            };
            let (missing, strange) = (less(&elsewhere, &own), less(&own, &elsewhere));
            assert!(
                missing.is_empty() && strange.is_empty(),
                "{name} at {angle}°: no {missing:#?}, but {strange:#?}"
            );
        }
    }
}
