//! Reports in the languages of the sheets: not a word of English is left in them, and numbers and symbols stay as they are.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use linkgram::grade::{GradeSettings, Kind, Report, grade, grade_with_overlay, read_answers};
use linkgram::render::{Format, Options, render};
use linkgram::sheet::Language;
use serde_json::json;

use crate::common::hand_in::{SLIDER, right, slider};

/// Hand-ins that show every part of a report.
fn hand_ins() -> Vec<serde_json::Value> {
    let own = right();
    let polar = |x: f64, unit: &str| json!({ "magnitude": format!("{:.1} {unit}", x.abs()), "direction": if x < 0.0 { 180 } else { 0 } });
    let rate = |x: f64, unit: &str| format!("{:.3} {unit} {}", x.abs(), if x < 0.0 { "cw" } else { "ccw" });
    let [v, a] = [polar(own.speed, "cm/s"), polar(own.acceleration, "cm/s^2")];
    let [omega, alpha] = [rate(own.omega, "rad/s"), rate(own.alpha, "rad/s^2")];
    vec![
        // Right, with and without a sense, and one answer missing.
        json!({ "values": { "v(B)": v, "omega(3)": own.omega.abs(), "a(B)": a } }),
        // A sense, a scale, a unit, a number that nothing explains.
        json!({ "values": { "v(B)": v, "omega(3)": rate(-own.omega, "rad/s"), "a(B)": a, "alpha(3)": alpha } }),
        json!({ "values": { "v(B)": polar(2.0 * own.speed, "cm/s"), "omega(3)": rate(2.0 * own.omega, "rad/s"),
                            "a(B)": a, "alpha(3)": alpha } }),
        json!({ "values": { "v(B)": polar(-0.37 * own.speed, "cm/s"), "omega(3)": omega, "a(B)": a },
                "tolerance": { "length": "0.5 mm" } }),
        json!({ "values": { "v(B)": v, "omega(3)": omega, "a(B)": { "components": [own.acceleration, 220.0] } },
                "lengths": { "v(B)": 3.0 } }),
    ]
}

fn report(language: Language, answers: &serde_json::Value) -> Report {
    let settings = GradeSettings { language, ..GradeSettings::default() };
    let scene = slider();
    grade(&scene, &read_answers(&answers.to_string(), &scene).unwrap(), &settings).unwrap()
}

/// Words of Latin letters that are no symbols or units.
fn foreign(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !c.is_ascii_alphabetic());
    words.filter(|word| word.len() > 2 && !["rad", "deg", "rpm", "bdi"].contains(word)).collect()
}

#[test]
fn no_english_is_left_in_a_report_of_another_language() {
    for language in [Language::Arabic, Language::ArabicAjala, Language::Persian] {
        for answers in hand_ins() {
            let told = report(language, &answers);
            let text = told.to_text();
            assert!(foreign(&text).is_empty(), "{:?}\n{text}", foreign(&text));
            // The same judgement, whatever the language.
            let english = report(Language::English, &answers);
            assert_eq!(told.sum(), english.sum());
            assert!(english.to_text().contains("marks: "));
            let page = told.to_html("", None);
            let tag = language.words().tag;
            assert!(page.contains(&format!("<html lang=\"{tag}\" dir=\"rtl\">")), "{page}");
            let body = page.split("<body>").nth(1).unwrap();
            let plain: String =
                body.split('<').filter_map(|piece| piece.split_once('>')).map(|(_, t)| t).collect();
            assert!(foreign(&plain).is_empty(), "{:?}\n{plain}", foreign(&plain));
        }
    }
}

/// Every mistake has its sentence in every language.
#[test]
fn a_mistake_is_told_in_the_language_of_the_report() {
    let answers = &hand_ins()[1];
    for (language, wanted) in [
        (Language::English, "the opposite sense"),
        (Language::Arabic, "الاتجاه معكوس"),
        (Language::Persian, "جهت وارونه"),
    ] {
        let told = report(language, answers);
        let mistake = &told.first_fault().unwrap().mistakes[0];
        assert_eq!(mistake.kind, Kind::SenseReversed);
        assert!(mistake.text().told(language).contains(wanted));
        assert!(told.to_text().contains(wanted), "{}", told.to_text());
        assert!(told.to_json().to_string().contains(wanted));
    }
}

#[test]
fn the_overlay_speaks_the_language_of_the_report() {
    let scene = slider();
    let answers = read_answers(&hand_ins()[2].to_string(), &scene).unwrap();
    let settings = GradeSettings { language: Language::Arabic, ..GradeSettings::default() };
    let (_, figure) = grade_with_overlay(&scene, &answers, &settings).unwrap();
    let figure = figure.unwrap();
    assert!(foreign(&figure.description).is_empty(), "{}", figure.description);
    assert_eq!(figure.language, "ar");
    let svg = render(&figure, Format::Svg, &Options::default()).unwrap();
    let svg = String::from_utf8(svg).unwrap();
    assert!(!svg.contains("yours") && !svg.contains("fault shows"), "{svg}");
}

#[test]
fn the_command_takes_the_language_that_is_wished_or_that_of_the_sheet() {
    let folder = std::env::temp_dir().join(format!("linkgram-language-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let arabic = SLIDER.replace("\"sheet\": {", "\"sheet\": { \"language\": \"ar\",");
    std::fs::write(folder.join("scene.json"), SLIDER).unwrap();
    std::fs::write(folder.join("arabic.json"), arabic).unwrap();
    std::fs::write(folder.join("a.json"), hand_ins()[0].to_string()).unwrap();
    let run = |arguments: &[&str]| {
        let program = env!("CARGO_BIN_EXE_linkgram");
        let ran = std::process::Command::new(program).args(arguments).current_dir(&folder).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (ran.status.code(), text(ran.stdout), text(ran.stderr))
    };
    let told = |arguments: &[&str]| run(&[&["grade"], arguments].concat()).1;
    assert!(told(&["scene.json", "a.json"]).contains("marks: "));
    assert!(told(&["scene.json", "a.json", "--lang", "fa"]).contains("نمره: "));
    assert!(told(&["arabic.json", "a.json"]).contains("العلامات: "));
    assert!(told(&["arabic.json", "a.json", "--lang", "en"]).contains("marks: "));
    run(&["grade", "arabic.json", "a.json", "-o", "a.html"]);
    assert!(std::fs::read_to_string(folder.join("a.html")).unwrap().contains("dir=\"rtl\""));
    let (code, _, err) = run(&["grade", "scene.json", "a.json", "--lang", "xx"]);
    assert!(code == Some(2) && err.contains("language xx is not available"), "{err}");
    std::fs::remove_dir_all(&folder).unwrap();
}
