//! Grading: published values are right, and every known misprint is found; answers in every form that may be
//! handed in, on a slider-crank with closed-form answers.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::path::{Path, PathBuf};

use linkgram::drawing::{self, Wish};
use linkgram::grade::{GradeSettings, Kind, Report, Verdict, grade, read_answers};
use linkgram::render::{Format, Options, render};
use linkgram::scene::{self, Scene};
use serde_json::{Value, json};

fn scenes_in(folder: &str) -> Vec<(PathBuf, Scene, Value)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap();
        let scene = scene::read(&text, &path.display().to_string()).unwrap();
        let value = serde_json::from_str(&text).unwrap();
        (path, scene, value)
    };
    paths.into_iter().filter(|p| p.extension().is_some_and(|e| e == "json")).map(read).collect()
}

/// The published values of a scene as answers, with the deviations that the scene allows.
fn published(scene: &Value) -> Option<Value> {
    let published = scene.get("published")?.as_object()?;
    let mut values = serde_json::Map::new();
    let mut tolerances = serde_json::Map::new();
    for (name, value) in published {
        let stated = value.get("value").unwrap_or(value);
        values.insert(name.clone(), stated.clone());
        let within = value.get("within").cloned().unwrap_or(json!("5 %"));
        let within = within.as_f64().map_or(within, |part| json!(format!("{} %", 100.0 * part)));
        tolerances.insert(name.clone(), within);
    }
    Some(json!({ "values": values, "tolerance": tolerances }))
}

fn graded(scene: &Scene, answers: &Value) -> Report {
    let answers = read_answers(&answers.to_string(), scene).unwrap();
    // The deviations of what is printed are the examiner's.
    grade(scene, &answers, &GradeSettings { trusts_answers: true, ..GradeSettings::default() }).unwrap()
}

#[test]
fn published_values_are_right() {
    let mut answers = 0;
    for folder in ["examples", "examples/pairs", "examples/centres", "examples/constructions"] {
        for (path, scene, value) in scenes_in(folder) {
            let Some(handed_in) = published(&value) else { continue };
            let report = graded(&scene, &handed_in);
            for graded in &report.quantities {
                answers += 1;
                assert_eq!(graded.verdict, Verdict::Right, "{}: {}: {graded:?}", path.display(), graded.name);
            }
        }
    }
    assert!(answers > 200, "{answers} published values");
}

#[test]
fn every_misprint_is_found() {
    let mut found = 0;
    for (path, scene, value) in scenes_in("examples/errata") {
        let Some(handed_in) = published(&value) else { continue };
        let report = graded(&scene, &handed_in);
        for graded in &report.quantities {
            let misprint = scene.errata.contains(&graded.name);
            let right = graded.verdict == Verdict::Right;
            assert_eq!(right, !misprint, "{}: {}: {graded:?}", path.display(), graded.name);
            found += usize::from(misprint);
        }
        let fault = report.first_fault().unwrap_or_else(|| panic!("{}: no fault", path.display()));
        assert!(scene.errata.iter().any(|name| name == fault.name), "{}: {fault:?}", path.display());
    }
    assert!(found >= 12, "{found} misprints");
}

/// Crank 30 cm upright, rod 50 cm, 10 rad/s counter-clockwise: the rod only translates. V = 300 cm/s to the left;
/// with A = 3000 cm/s² downward at the crank pin, ε of the rod is 3000/40 and A of the slider 30 · 75 = 2250 to the
/// right.
fn slider_crank() -> Scene {
    scene::read(scene_text(), "slider.json").unwrap()
}

fn scene_text() -> &'static str {
    r#"{
        "units": { "length": "cm" },
        "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
        "near": { "B": [40, 0] },
        "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
        "find": ["v(B)", "a(B)", "alpha(3)"],
        "sheet": { "length": "1:10", "velocity": "50 cm/s per cm", "acceleration": "500 cm/s^2 per cm",
                   "marks": { "alpha(3)": 3 } }
    }"#
}

#[test]
fn answers_in_every_form() {
    let scene = slider_crank();
    let right = [
        json!({ "values": { "v(B)": "300 cm/s", "a(B)": "22.5 m/s^2", "alpha(3)": "75 rad/s^2 ccw" } }),
        json!({ "units": { "length": "mm" }, "values": { "v(B)": 3000, "alpha(3)": 75 } }),
        json!({ "values": { "v(B)": { "magnitude": "3 m/s", "direction": "180 deg" },
                            "a(B)": { "components": [2250, 0] }, "x(B)": [40, 0] } }),
        json!({ "lengths": { "v(B)": 60.1, "a(B)": 45, "an(A)": 60 } }),
        json!({ "points": { "velocity": { "o": [10, 10], "a": [-50, 10], "b": [-50.1, 10] },
                            "acceleration": { "o'": [0, 0], "a'": [0, -60], "b'": [45, 0] },
                            "skeleton": { "O2": [100, 100], "A": [100, 130], "B": [140, 100] } } }),
        json!({ "points": { "velocity": { "o": [100, 100], "b": [100, 700] } },
                "scan": { "velocity": { "pixels": [[0, 0], [0, 1000]], "mm": [[0, 0], [-100, 0]] } } }),
    ];
    for answers in right {
        let report = graded(&scene, &answers);
        assert!(!report.quantities.is_empty());
        assert!(report.quantities.iter().all(|q| q.verdict == Verdict::Right), "{}", report.to_text());
    }
    let csv = "quantity,value,unit,sense,direction\nv(B),3,m/s,,180\na(B),45,mm,,\nalpha(3),75,rad/s^2,ccw,\n\
               figure,point,x,y\nvelocity,o,0,0\nvelocity,b,-60,0\n";
    let answers = read_answers(csv, &scene).unwrap();
    let report = grade(&scene, &answers, &GradeSettings::default()).unwrap();
    assert_eq!(report.quantities.len(), 4);
    // What the drawing shows of v(B) is its second answer, and brings nothing more.
    assert!(report.holds() && report.sum() == (5.0, 5.0), "{}", report.to_text());
    // Places and vectors by their components.
    let csv = "quantity,x,y,unit\nx(B),0.4,0,m\na(B),2250,0,cm/s^2\n";
    let answers = read_answers(csv, &scene).unwrap();
    let report = grade(&scene, &answers, &GradeSettings::default()).unwrap();
    assert_eq!(report.quantities.len(), 2);
    assert!(report.holds(), "{}", report.to_text());
}

#[test]
fn marks_for_what_is_no_quantity_are_refused() {
    let misspelt = scene_text().replace(r#""alpha(3)": 3"#, r#""alfa(3)": 3"#);
    let refused = scene::read(&misspelt, "slider.json").unwrap_err().to_string();
    assert!(refused.contains("sheet.marks") && refused.contains("`alpha`"), "{refused}");
}

#[test]
fn what_follows_rightly_is_consistent() {
    let scene = slider_crank();
    // Twice the speed by a slip that no list foresees, and everything from it: A = V²/l.
    let answers = json!({ "values": { "v(A)": "390 cm/s", "v(B)": "390 cm/s", "a(A)": "5070 cm/s^2",
                                      "a(B)": "3802.5 cm/s^2", "alpha(3)": "126.75 rad/s^2" } });
    let report = graded(&scene, &answers);
    let verdicts: Vec<Verdict> = report.quantities.iter().map(|q| q.verdict).collect();
    assert_eq!(verdicts[0], Verdict::Wrong, "{}", report.to_text());
    assert!(verdicts[1..].iter().all(|v| *v == Verdict::Consistent), "{}", report.to_text());
    assert!(report.first_fault().unwrap().mistakes.is_empty(), "{}", report.to_text());
}

#[test]
fn a_reversed_sense_is_named() {
    let scene = slider_crank();
    let answers = json!({ "values": { "v(B)": "300 cm/s", "a(B)": { "components": [2250, 0] },
                                      "alpha(3)": "75 rad/s^2 cw" } });
    let report = graded(&scene, &answers);
    let fault = report.first_fault().unwrap();
    assert_eq!((fault.name, fault.mistakes[0].kind), ("alpha(3)", Kind::SenseReversed));
    assert_eq!(report.sum(), (2.0, 5.0));
}

#[test]
fn bad_answers_are_refused_with_place_and_mend() {
    let scene = slider_crank();
    let refusal = |text: &str| match read_answers(text, &scene) {
        Err(diagnostic) => diagnostic.to_string(),
        Ok(answers) => match grade(&scene, &answers, &GradeSettings::default()) {
            Err(error) => error.to_string(),
            Ok(report) => report.to_text(),
        },
    };
    let cases = [
        (r#"{ "value": {} }"#, "answers:1:3: value: unknown key `value`; help: did you mean `values`?"),
        (r#"{ "values": { "v(Q)": 3 } }"#, "`v(Q)`: there is no point `Q`"),
        (r#"{ "values": { "v(B)": "3 cm" } }"#, "`cm` measures a length, but a velocity is expected here"),
        (r#"{ "values": { "v(B)": 3, "v( B )": 4 } }"#, "`v( B )` is answered twice"),
        (r#"{ "values": { "omega(3)": [1, 2] } }"#, "is a number, not a vector"),
        (r#"{ "points": { "velocity": { "b": [1, 2] } } }"#, "the pole is missing"),
        (r#"{ "points": { "velocity": { "o": [0, 0], "q": [1, 2] } } }"#, "has no point `q`"),
        ("v(B);3", "answers:1:1: neither JSON nor a table with a known header"),
        ("quantity,value,x,y\nx(B),3,4,5", "answers:2:8: both a value and a component"),
        ("quantity,x,y,sense\nx(B),4,5,cw", "answers:2:10: two components have their direction already"),
        ("quantity,x,y\nx(B),4", "this row has no `value`"),
        ("quantity,value\nv(B),fast", "answers:2:6: `fast` does not begin with a number"),
    ];
    for (text, expected) in cases {
        let told = refusal(text);
        assert!(told.contains(expected), "{text}\n{told}");
    }
}

#[test]
fn the_overlay_circles_the_first_fault() {
    let scene = slider_crank();
    // Coriolis is not at stake here: the normal part of the crank pin points away from O2.
    let answers = json!({ "values": { "an(A)": { "magnitude": "3000 cm/s^2", "direction": "90 deg" },
                                      "a(B)": { "components": [-2250, 0] }, "alpha(3)": "75 rad/s^2 cw" } });
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let (report, figure) =
        linkgram::grade::grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
    assert_eq!(report.first_fault().unwrap().mistakes[0].kind, Kind::NormalAwayFromCentre);
    let verdicts: Vec<Verdict> = report.quantities.iter().map(|q| q.verdict).collect();
    assert_eq!(verdicts, [Verdict::Wrong, Verdict::Consistent, Verdict::Consistent]);
    let figure = figure.unwrap();
    let (mut dashed, mut circles) = (0, 0);
    figure.root.walk(&mut |node| {
        if let linkgram::sheet::figure::Node::Mark(mark) = node {
            dashed += usize::from(mark.class == "student");
            circles += usize::from(mark.class == "fault");
        }
    });
    assert!(dashed > 0 && circles == 1);
    assert!(figure.description.contains("AⁿA points away from its centre"), "{}", figure.description);
}

#[test]
fn the_command_tells_by_its_exit_status() {
    let folder = std::env::temp_dir().join(format!("linkgram-grade-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scene.json"), scene_text()).unwrap();
    let cases = [
        (r#"{ "values": { "v(B)": 300 } }"#, 0),
        (r#"{ "values": { "v(B)": 200 } }"#, 1),
        (r#"{ "values": { "v(X)": 200 } }"#, 2),
        ("{}", 2),
    ];
    for (answers, status) in cases {
        std::fs::write(folder.join("answers.json"), answers).unwrap();
        let _ = std::fs::remove_file(folder.join("overlay.svg"));
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_linkgram"))
            .args(["grade", "scene.json", "answers.json", "-o", "overlay.svg"])
            .current_dir(&folder)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(status), "{answers}: {output:?}");
        assert_eq!(folder.join("overlay.svg").exists(), status < 2, "{answers}");
        assert_eq!(output.stdout.is_empty(), status == 2);
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The three figures of the slider-crank as a vector editor saves them: a page in millimetres, a layer that is
/// shifted and one that is scaled, arrows as lines with markers, styles, letters beside what they name. `b` is the
/// velocity image of the slider, in the units of its layer.
fn drawn_slider_crank(b: &str) -> String {
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="297mm" viewBox="0 0 210 297">
  <defs><marker id="arrow"><path d="M 0,0 L 4,2 L 0,4 Z"/></marker></defs>
  <g transform="translate(100,100)" style="font-size:4px">
    <path d="M 0,0 V -30 L 40,0"/><text x="-5" y="5">O<tspan font-size="2.8" dy="1">2</tspan></text>
    <text x="1" y="-31">A</text><text x="41" y="-1">B</text>
    <text x="0" y="20">Velocities, 50 cm/s per cm</text>
  </g>
  <g transform="translate(100 150) scale(2)" style="font-size:2px">
    <path d="m 0,0 h -30" marker-end="url(#arrow)"/><line x1="0" y1="0" x2="{b}" y2="0"/>
    <text x="0.5" y="-0.5">o</text><text><tspan x="-31.5" y="-0.8">a</tspan></text>
    <text x="{b}" y="2.6" text-anchor="middle">b</text>
  </g>
  <g transform="rotate(90 20 200) translate(20 200)">
    <circle cx="0" cy="0" r="0.5"/><circle cx="60" cy="0" r="0.5"/><circle cx="0" cy="-45" r="0.5"/>
    <text x="1" y="1" font-size="4">o'</text><text x="61" y="1" font-size="4">a′</text>
    <text x="1" y="-46" font-size="4">b'</text>
  </g>
</svg>"##
    )
}

#[test]
fn a_drawing_of_a_vector_editor_is_read() {
    let scene = slider_crank();
    let judged = |svg: &str| {
        let answers = read_answers(svg, &scene).unwrap();
        grade(&scene, &answers, &GradeSettings::default()).unwrap()
    };
    let right = judged(&drawn_slider_crank("-30"));
    let names: Vec<&str> = right.quantities.iter().map(|q| q.name.as_str()).collect();
    assert_eq!(names.len(), 6, "{names:?}");
    assert!(right.holds(), "{}", right.to_text());
    let wrong = judged(&drawn_slider_crank("-22"));
    assert_eq!(wrong.first_fault().unwrap().name, "velocity:b", "{}", wrong.to_text());
    // The finished sheet of another program, this one, is a drawing too.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| std::fs::read_to_string(folder.join(path)).unwrap();
    let scene = scene::read(&read("examples/s000-ch3a-1.json"), "six-link.json").unwrap();
    let answers = read_answers(&read("golden/s000-ch3a-1.svg"), &scene).unwrap();
    let report = grade(&scene, &answers, &GradeSettings::default()).unwrap();
    assert!(report.quantities.len() > 12 && report.holds(), "{}", report.to_text());
}

/// A sheet of this program names its points itself, whatever stands beside them, and says at which scale it is drawn.
#[test]
fn every_sheet_of_this_program_is_read_back_whole() {
    let (mut sheets, mut points) = (0, 0);
    for kind in linkgram::catalogue::KINDS {
        let scene = scene::read(kind.scene, kind.name).unwrap();
        if scene.mechanism.points.is_empty() {
            continue;
        }
        for paper in ["A4", "A6 landscape"] {
            let mut stated: Value = serde_json::from_str(kind.scene).unwrap();
            stated["sheet"]["paper"] = paper.into();
            let drawn = scene::read(&stated.to_string(), kind.name).unwrap();
            // Not every mechanism has room on a small sheet.
            let Ok(figure) = drawing::figure(&drawn, &Wish::default()) else { continue };
            let svg = render(&figure, Format::Svg, &Options::default()).unwrap();
            let svg = String::from_utf8(svg).unwrap();
            let answers = match read_answers(&svg, &scene) {
                Ok(answers) => answers,
                Err(why) => panic!("{} on {paper}: {why}", kind.name),
            };
            // A skeleton alone may ask for nothing that is drawn.
            let report = match grade(&scene, &answers, &GradeSettings::default()) {
                Ok(report) => report,
                Err(why) => panic!("{} on {paper}: {why}", kind.name),
            };
            assert!(report.holds(), "{} on {paper}: {}", kind.name, report.to_text());
            sheets += 1;
            points += report.quantities.len();
        }
    }
    assert!(sheets > 80 && points > 600, "{sheets} sheets with {points} points");
}

/// A prime is one, whatever key it was typed with.
#[test]
fn primes_are_read_as_keyboards_have_them() {
    let kind = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == "four-bar").unwrap();
    let scene = scene::read(kind.scene, kind.name).unwrap();
    let figure = drawing::figure(&scene, &Wish::default()).unwrap();
    let svg = String::from_utf8(render(&figure, Format::Svg, &Options::default()).unwrap()).unwrap();
    let read = |svg: &str| {
        let answers = read_answers(svg, &scene).unwrap();
        grade(&scene, &answers, &GradeSettings::default()).unwrap().quantities.len()
    };
    let all = read(&svg);
    for prime in ["'", "’", "´", "ʹ", "`"] {
        let typed = svg.replace('′', prime);
        assert!(typed != svg, "primes are printed as they are");
        assert_eq!(read(&typed), all, "{prime}");
    }
}

#[test]
fn a_drawing_that_cannot_be_read_says_why() {
    let scene = slider_crank();
    let refused = |svg: &str| read_answers(svg, &scene).unwrap_err().to_string();
    let page = |inside: &str| {
        format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 99 99">{inside}</svg>"#)
    };
    assert!(refused("<svg").contains("answers:1:"), "{}", refused("<svg"));
    assert!(refused("<html/>").contains("nor an SVG"));
    assert!(refused(&page("<text>Given</text>")).contains("no letter of this drawing"));
    let far = refused(&page(r#"<circle cx="0" cy="0" r="1"/><text x="400" y="90">A</text>"#));
    assert!(far.contains("nothing is marked beside the letter `A`"), "{far}");
    let twice =
        r#"<circle cx="0" cy="0"/><circle cx="900" cy="0"/><text x="1">A</text><text x="901">A</text>"#;
    assert!(refused(&page(twice)).contains("`A` names two points"));
    let mut both =
        read_answers(r#"{ "points": { "velocity": { "o": [0, 0] } }, "drawing": "d.svg" }"#, &scene).unwrap();
    let clash = both.add_drawing(&drawn_slider_crank("-30"), "d.svg", &scene).unwrap_err().to_string();
    assert!(clash.contains("in `points` and in the drawing"), "{clash}");
}

#[test]
fn a_sign_that_no_magnitude_has_is_refused() {
    let scene = slider_crank();
    let told = |text: &str| read_answers(text, &scene).map_or_else(|e| e.to_string(), |_| "taken".to_owned());
    let negative = "the magnitude of `v(B)` is not negative; help: give its `direction`, ccw from +x";
    for v in ["-300", "\"-300 cm/s\"", r#"{ "magnitude": -300, "direction": 0 }"#, r#"{ "value": "-3 m/s" }"#]
    {
        let said = told(&format!(r#"{{ "values": {{ "v(B)": {v} }} }}"#));
        assert!(said.contains(negative) && said.contains("values.v(B)"), "{v}: {said}");
    }
    let said = told("quantity,value,unit,direction\nv(B),-300,cm/s,0\n");
    assert!(said.starts_with("answers:2:6: ") && said.contains(negative), "{said}");
    let alpha = |value: &str| told(&format!(r#"{{ "values": {{ "alpha(3)": {value} }} }}"#));
    assert_eq!(alpha("-75"), "taken");
    assert!(alpha(r#"{ "magnitude": -75 }"#).contains("a magnitude is not negative"));
    for twice in [
        r#""-75 rad/s^2 cw""#,
        r#"{ "value": -75, "sense": "cw" }"#,
        r#"{ "value": "75 rad/s^2 cw", "sense": "cw" }"#,
    ] {
        let said = alpha(twice);
        assert!(said.contains("keep one of the two: `cw`, `ccw` or the sign"), "{twice}: {said}");
    }
    assert!(told(r#"{ "values": { "rho(A)": -30 } }"#).contains("`rho(A)` is never negative"));
}

/// The drawing of the slider-crank with one thing in it said otherwise.
#[test]
fn what_a_drawing_says_of_its_places_is_read_or_told() {
    let scene = slider_crank();
    let told = |svg: &str| read_answers(svg, &scene).map_or_else(|e| e.to_string(), |_| "taken".to_owned());
    let page = |head: &str, inside: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" {head}>\n<g id=\"velocity\">\n{inside}\n</g></svg>"
        )
    };
    let with = |b: &str| {
        let pole = r#"<circle cx="10" cy="10" r="1"/><text x="11" y="9" font-size="4">o</text>"#;
        page(r#"width="200mm" height="200mm" viewBox="0 0 200 200""#, &format!("{pole}\n{b}"))
    };
    let text = r#"<text x="41" y="9" font-size="4">b</text>"#;
    let circle = |cx: &str| with(&format!("<circle cx=\"{cx}\" cy=\"10\" r=\"1\"/>{text}"));
    assert_eq!(told(&circle("40")), "taken");
    assert_eq!(told(&circle("40px")), "taken");
    assert_eq!(told(&circle("30pt")), "taken");
    for (cx, why) in [
        (
            "30%",
            "is a part of something else, and no length on the page; help: write it in px, mm, cm, in, pt or pc",
        ),
        ("3em", "is a part of something else"),
        ("30 furlong", "is no length"),
        ("NaN", "is no length"),
        ("1e400", "is no length"),
    ] {
        let said = told(&circle(cx));
        assert!(said.starts_with(&format!("answers:4:13: `cx=\"{cx}\"` of `circle` ")), "{said}");
        assert!(said.contains(why), "{said}");
    }
    let cases = [
        (with(&format!(r#"<line x1="10" y1="10" x2="4%" y2="10"/>{text}"#)), "`x2=\"4%\"` of `line`"),
        (with(&format!(r#"<polyline points="10,10 40"/>{text}"#)), "has a coordinate without its other one"),
        (with(&format!(r#"<polyline points="10,10 a,b"/>{text}"#)), "is no list of numbers"),
        (
            with(&format!(r#"<path d="M10 10 L40 10 L1e400 5"/>{text}"#)),
            "cannot be read behind its first 2 parts",
        ),
        (with(r#"<circle cx="40" cy="10" r="1"/><text x="20%" y="9">b</text>"#), "`x=\"20%\"` of `text`"),
        (
            with(&format!(r#"<g transform="rotate(foo)"><circle cx="40" cy="10"/></g>{text}"#)),
            "is no transform",
        ),
        (
            with(&format!(
                r#"<g style="fill:none; transform: translate(50px,0)"><circle cx="40" cy="10"/></g>{text}"#
            )),
            "says `transform`, which is not read in a style",
        ),
        (
            with(&format!(
                r#"<style>circle {{ transform: translate(50px,0) }}</style><circle cx="40" cy="10"/>{text}"#
            )),
            "the style sheet says `transform`",
        ),
        (page(r#"viewBox="0 0 0 0""#, text), "`viewBox=\"0 0 0 0\"` of `svg` has no width or no height"),
        (page(r#"viewBox="0 0 -1 1e-300""#, text), "has no width or no height"),
        (page(r#"viewBox="0 0 9""#, text), "is not four numbers"),
        (page(r#"viewBox="0 0 9 9" width="0""#, text), "is no side of a page"),
        (page(r#"viewBox="0 0 9 9" width="20em""#, text), "is a part of something else"),
    ];
    for (svg, why) in cases {
        let said = told(&svg);
        assert!(said.contains(why), "{why}\n{said}\n{svg}");
    }
    // Half the page: all is half as long.
    let drawn = |head: &str, b: &str| {
        let inside = format!(
            r#"<circle cx="10" cy="100"/><text x="11" y="99" font-size="4">o</text><circle cx="{b}" cy="100"/><text x="{b}" y="99" font-size="4">b</text>"#
        );
        let answers = read_answers(&page(head, &inside), &scene).unwrap();
        grade(&scene, &answers, &GradeSettings::default()).unwrap()
    };
    assert!(drawn(r#"width="200mm" height="200mm" viewBox="0 0 200 200""#, "-50").holds());
    assert!(drawn(r#"width="400mm" height="200mm" viewBox="0 0 200 200""#, "-50").holds());
    assert!(drawn(r#"width="100%" height="100mm" viewBox="0 0 200 200""#, "-110").holds());
}

#[test]
fn a_scale_that_no_paper_has_is_refused() {
    let scene = slider_crank();
    let told = |scale: &str| {
        let text = format!(r#"{{ "scales": {{ "velocity": "{scale}" }}, "values": {{ "v(B)": 300 }} }}"#);
        let answers = read_answers(&text, &scene).unwrap();
        let report = grade(&scene, &answers, &GradeSettings::default()).unwrap();
        // The value hangs on no scale.
        assert_eq!(report.quantities[0].verdict, Verdict::Right);
        report.not_read.first().map_or("taken".to_owned(), |one| one.why.to_string())
    };
    assert_eq!(told("50 cm/s per cm"), "taken");
    assert_eq!(told("50 m/s per mm"), "taken");
    let said = told("1e-60 mm/s per mm");
    assert!(
        said.contains("scales.velocity: at this scale the right drawing would be 3e63 mm large"),
        "{said}"
    );
    assert!(told("1e50 m/s per mm").contains("mm large"));
}
