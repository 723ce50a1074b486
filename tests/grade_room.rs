//! The grading room with what a class hands in: padded sheets, nonsense that follows from nothing, the beginner's
//! mistakes, tables as an exam writes them, and digits as they are written where the class sits.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use linkgram::grade::{GradeSettings, Kind, Report, Verdict, class_faults, grade, read_answers};
use linkgram::grade::{HandIn, Mistake};
use linkgram::scene::{self, Scene};
use serde_json::{Value, json};

fn offset_slider(find: &str) -> Scene {
    let text = format!(
        r#"{{
        "units": {{ "length": "in" }},
        "fixed": {{ "O2": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 3 }}, "3": {{ "joins": ["A", "B"], "length": 9 }} }},
        "slides": [{{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, 1], "angle": 0 }} }}],
        "near": {{ "B": [10, 1] }},
        "input": {{ "link": 2, "angle": 60, "omega": "20 rad/s cw", "alpha": "15 rad/s^2 ccw" }},
        "pins": {{ "A": {{ "diameter": "1 in" }} }},
        "sheet": {{ "marks": {{ "v(B)": 2 }} }}
        {find} }}"#
    );
    scene::read(&text, "slider.json").unwrap()
}

const FIND: &str = r#", "find": ["v(B)", "omega(3)", "a(B)", "alpha(3)"]"#;

fn slider_in_line() -> Scene {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 120 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
        "near": { "B": [130, 0] }, "input": { "link": 2, "angle": 60, "omega": "300 rpm ccw" },
        "find": ["v(B)", "omega(3)", "a(B)", "alpha(3)"] }"#;
    scene::read(text, "in-line.json").unwrap()
}

fn four_bar() -> Scene {
    let text = r#"{ "units": { "length": "ft" }, "fixed": { "O2": [0, 0], "O4": [4, 0.5] },
        "links": { "2": { "joins": ["O2", "A"], "length": 1.2 },
                   "3": { "joins": ["A", "B", "P"], "sides": [3.5, 1.5, 2.8], "turn": "cw" },
                   "4": { "joins": ["O4", "B"], "length": 2.4 } },
        "near": { "B": [3.5, 2.8] },
        "input": { "link": 2, "angle": 55, "omega": "12 rad/s ccw", "alpha": "20 rad/s^2 cw" },
        "find": ["v(B)", "v(P)", "omega(3)", "omega(4)", "a(B)", "alpha(3)", "alpha(4)"] }"#;
    scene::read(text, "four-bar.json").unwrap()
}

fn graded(scene: &Scene, answers: &Value) -> Report {
    let answers = read_answers(&answers.to_string(), scene).unwrap();
    grade(scene, &answers, &GradeSettings::default()).unwrap()
}

fn tabled(scene: &Scene, rows: &str) -> Result<Report, String> {
    let table = format!("quantity,value,x,y,unit,sense,direction\n{rows}");
    let answers = read_answers(&table, scene).map_err(|refused| refused.to_string())?;
    grade(scene, &answers, &GradeSettings::default()).map_err(|refused| refused.to_string())
}

fn polar(magnitude: f64, direction: f64) -> Value {
    json!({ "magnitude": magnitude, "direction": direction })
}

/// All that the slider's scene asks, right.
fn right() -> Value {
    json!({ "v(B)": polar(57.37, 0.0), "omega(3)": 3.387, "a(B)": polar(560.5, 180.0), "alpha(3)": 112.7 })
}

fn first(report: &Report) -> &Mistake {
    let fault = report.first_fault().unwrap_or_else(|| panic!("no fault: {}", report.to_text()));
    fault.mistakes.first().unwrap_or_else(|| panic!("no mistake: {}", report.to_text()))
}

// --- marks -----------------------------------------------------------------------------------------------------------

#[test]
fn what_is_not_asked_brings_no_marks() {
    let scene = offset_slider(FIND);
    let mut padded = json!({ "v(B)": 999, "omega(3)": 99, "a(B)": 9, "alpha(3)": 9 });
    let padding = json!({ "omega(2)": "20 rad/s cw", "v(A)": 60, "a(A)": 1200.8, "an(A)": 1200, "at(A)": 45,
                          "x(O2)": [0, 0], "v(O2)": 0, "omega(1)": 0, "omega(4)": 0, "angle(2)": 60 });
    padded.as_object_mut().unwrap().extend(padding.as_object().unwrap().clone());
    let report = graded(&scene, &json!({ "values": padded }));
    assert_eq!(report.sum(), (0.0, 5.0), "{}", report.to_text());
    // They are judged and told all the same, as the reasons of what is asked.
    let unasked = report.quantities.iter().find(|graded| graded.name == "v(A)").unwrap();
    assert!(!unasked.asked && unasked.weight == 0.0 && unasked.verdict == Verdict::Right);
    assert!(report.to_text().contains("no marks"), "{}", report.to_text());
    // Nothing that is asked: nothing reached of everything.
    let report = graded(&scene, &json!({ "values": padding }));
    assert_eq!(report.sum(), (0.0, 5.0), "{}", report.to_text());
    assert_eq!(report.missing.len(), 4);
    // Without `find` everything is asked, and today's marks stay.
    let report = graded(&offset_slider(""), &json!({ "values": { "v(A)": 60, "an(A)": 1200 } }));
    assert_eq!(report.marks[0].of + report.marks[1].of, 2.0, "{}", report.to_text());
}

#[test]
fn marks_that_a_scene_sets_for_the_unasked_are_given() {
    let scene = offset_slider(r#", "find": ["omega(3)"]"#);
    let report = graded(&scene, &json!({ "values": { "v(B)": 57.37, "omega(3)": 3.387, "v(A)": 60 } }));
    assert_eq!(report.sum(), (3.0, 3.0), "{}", report.to_text());
}

#[test]
fn what_is_asked_keeps_its_marks_however_often_it_is_handed_in() {
    let scene = offset_slider(FIND);
    let once = graded(&scene, &json!({ "values": right() }));
    assert_eq!(once.sum(), (5.0, 5.0), "{}", once.to_text());
    let drawing = json!({ "velocity": { "o": [0, 0], "a": [51.96, -30], "b": [57.37, 0] } });
    let scales = json!({ "velocity": "1 in/s per mm", "acceleration": "10 in/s^2 per mm" });
    let lengths = json!({ "v(B)": 57.4, "a(B)": 56.0 });
    let often = json!({ "values": right(), "lengths": lengths, "points": drawing, "scales": scales });
    let report = graded(&scene, &often);
    assert_eq!(report.sum().1, 5.0, "{}", report.to_text());
    // The drawing alone stands for what it shows.
    let report = graded(&scene, &json!({ "points": drawing, "scales": scales }));
    assert_eq!(report.sum(), (2.0, 5.0), "{}", report.to_text());
    assert_eq!(report.missing.len(), 3);
    // So does it for a difference of two of its points.
    let scene = offset_slider(r#", "find": ["v(B/A)"]"#);
    let report = graded(&scene, &json!({ "points": drawing, "scales": scales }));
    assert_eq!((report.sum(), report.missing.len()), ((1.0, 1.0), 0), "{}", report.to_text());
}

#[test]
fn what_is_asked_twice_is_answered_twice() {
    let scene = offset_slider(
        r#", "find": ["v(B)", { "name": "v(B)", "unit": "ft/s", "method": "centres" }, "omega(3)", "rub(A)"]"#,
    );
    let rows = "v(B),57.4,,,in/s,,0\nv(B),4.78,,,ft/s,,0\nomega(3),3.39,,,rad/s,ccw,\n";
    let report = tabled(&scene, rows).unwrap();
    assert_eq!(report.sum(), (5.0, 6.0), "{}", report.to_text());
    // The second of the two is wrong.
    let report = tabled(&scene, &rows.replace("4.78", "9.9")).unwrap();
    assert_eq!(report.sum(), (3.0, 6.0), "{}", report.to_text());
    // A file of keys has one for both.
    let report = graded(&scene, &json!({ "values": { "v(B)": polar(57.37, 0.0) } }));
    assert_eq!(report.sum(), (4.0, 6.0), "{}", report.to_text());
    // Of what is answered once more than it is asked none is read.
    let thrice = tabled(&scene, &format!("{rows}v(B),57.4,,,in/s,,0\n")).unwrap();
    assert!(thrice.to_text().contains("`v(B)` is answered twice"), "{}", thrice.to_text());
    assert_eq!((thrice.not_read.len(), thrice.sum()), (3, (1.0, 6.0)), "{}", thrice.to_text());
}

#[test]
fn an_exam_gives_sense_and_direction_their_part() {
    let by_parts = |scene: &Scene, values: Value| {
        let answers = read_answers(&json!({ "values": values }).to_string(), scene).unwrap();
        let settings = GradeSettings { by_parts: true, ..GradeSettings::default() };
        grade(scene, &answers, &settings).unwrap()
    };
    let scene = offset_slider(FIND);
    assert_eq!(by_parts(&scene, right()).sum(), (5.0, 5.0));
    // A fixed guide leaves the sense alone to choose: a quarter of a vector's marks.
    let report =
        by_parts(&scene, json!({ "v(B)": 57.37, "omega(3)": 3.387, "a(B)": 560.5, "alpha(3)": 112.7 }));
    assert_eq!(report.sum(), (1.5 + 1.0 + 0.75 + 1.0, 5.0), "{}", report.to_text());
    assert!(report.to_text().contains("direction is not told"), "{}", report.to_text());
    // Without a sense a rotation is counter-clockwise; this one is not.
    let report = by_parts(&slider_in_line(), json!({ "omega(3)": 5.469 }));
    assert_eq!(report.sum(), (0.75, 4.0), "{}", report.to_text());
    let report = by_parts(&four_bar(), json!({ "v(B)": 5.986 }));
    assert_eq!(report.sum(), (0.5, 7.0), "{}", report.to_text());
    // A single scene is graded as ever.
    assert_eq!(graded(&four_bar(), &json!({ "values": { "v(B)": 5.986 } })).sum(), (1.0, 7.0));
}

// --- what follows ------------------------------------------------------------------------------------------------------

#[test]
fn nonsense_follows_from_nothing() {
    let scene = offset_slider(FIND);
    for small in [1.0, 9.0, 20.0, 33.0] {
        let report = graded(&scene, &json!({ "values": { "alpha(3)": 9, "a(B)": small } }));
        let verdict = report.quantities.iter().find(|graded| graded.name == "a(B)").unwrap().verdict;
        assert_eq!(verdict, Verdict::Wrong, "{small}: {}", report.to_text());
    }
}

// --- mistakes ----------------------------------------------------------------------------------------------------------

#[test]
fn a_normal_part_that_was_left_out_is_named() {
    let slider = |a: f64, alpha: f64| json!({ "v(B)": polar(57.37, 0.0), "omega(3)": 3.387, "a(B)": polar(a, 180.0), "alpha(3)": alpha });
    let in_line = json!({ "v(B)": polar(1278.0, 180.0), "omega(3)": { "value": 5.469, "sense": "cw" },
                          "a(B)": polar(9431.0, 180.0), "alpha(3)": 297.6 });
    let bars = |a: [f64; 2], alpha: [f64; 2]| {
        json!({ "v(B)": polar(5.986, -171.2), "v(P)": polar(10.56, -178.0), "omega(3)": -3.112, "omega(4)": 2.494,
                "a(B)": polar(a[0], a[1]), "alpha(3)": alpha[0], "alpha(4)": alpha[1] })
    };
    let cases = [
        (offset_slider(FIND), slider(455.5, 114.8), "an(B/A)"),
        (offset_slider(FIND), slider(148.0, -4.61), "an(A)"),
        (slider_in_line(), in_line, "an(B/A)"),
        (four_bar(), bars([158.9, -165.9], [39.53, 65.94]), "an(B/A)"),
        (four_bar(), bars([202.0, -171.2], [48.49, 84.15]), "an(B)"),
        (four_bar(), bars([25.35, -135.2], [4.816, 8.538]), "an(A)"),
    ];
    for (scene, values, at) in cases {
        let report = graded(&scene, &json!({ "values": values }));
        let mistake = first(&report);
        assert_eq!((mistake.kind, &*mistake.at), (Kind::NormalMissing, at), "{}", report.to_text());
        assert!(mistake.text().contains("was left out") && mistake.also.is_none());
        let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).count();
        assert_eq!(wrong, 1, "the others follow: {}", report.to_text());
    }
}

#[test]
fn one_wrong_scale_explains_all_that_was_read() {
    let values = json!({ "v(B)": polar(114.7, 0.0), "omega(3)": 6.774, "a(B)": polar(1121.0, 180.0),
                         "alpha(3)": 225.4 });
    let report = graded(&offset_slider(FIND), &json!({ "values": values }));
    let mistake = first(&report);
    assert_eq!((mistake.kind, mistake.explains), (Kind::ScaleWrong, 4), "{}", report.to_text());
}

#[test]
fn of_two_mistakes_both_are_told() {
    let scene = offset_slider(FIND);
    let one = Mistake {
        kind: Kind::NormalMissing,
        at: "an(A)".into(),
        step: Some(8),
        how: None,
        residual: 0.1,
        explains: 2,
        also: None,
    };
    let both = Mistake {
        also: Some(Box::new(Mistake { kind: Kind::AlphaSign, at: "the input".into(), ..one.clone() })),
        ..one
    };
    assert_eq!(
        both.text(),
        "an(A) was left out; and the input: the angular acceleration with the opposite sense"
    );
    let mut report = graded(&scene, &json!({ "values": { "v(B)": 57.37, "alpha(3)": 9 } }));
    let wrong = report.quantities.iter_mut().find(|graded| graded.verdict == Verdict::Wrong).unwrap();
    wrong.mistakes = vec![both];
    let text = report.to_text();
    assert!(text.contains("Probably two mistakes at once: Aⁿ_A was left out (step 8"), "{text}");
    assert_eq!(report.to_json()["first_fault"]["mistakes"][0]["also"]["kind"], "alpha-sign");
    let class = [HandIn { file: "a".to_owned(), outcome: Ok(report) }];
    assert_eq!(class_faults(&class).len(), 2);
}

#[test]
fn a_cause_reaches_its_effect() {
    // A velocity a little beyond its tolerance; no mistake in the accelerations moves it.
    let scene = offset_slider(FIND);
    for off in [1.05, 1.1, 1.2] {
        let values = json!({ "v(B)": polar(57.37 * off, 0.0), "a(B)": polar(300.0, 180.0), "alpha(3)": 60 });
        let report = graded(&scene, &json!({ "values": values }));
        let Some(fault) = report.quantities.iter().find(|g| g.name == "v(B)" && g.verdict == Verdict::Wrong)
        else {
            continue;
        };
        for mistake in &fault.mistakes {
            assert!(!mistake.at.contains("a(") && !mistake.at.contains("an("), "{}", report.to_text());
            assert!(!matches!(mistake.kind, Kind::AlphaSign | Kind::AlphaIgnored | Kind::NormalMissing));
        }
    }
    // The square of ω has no sense: with α = 0 a reversed ω changes no acceleration.
    let values = json!({ "v(B)": polar(1278.0, 180.0), "omega(3)": -5.469, "a(B)": polar(11000.0, 180.0),
                         "alpha(3)": 289 });
    let report = graded(&slider_in_line(), &json!({ "values": values }));
    for mistake in report.quantities.iter().flat_map(|graded| &graded.mistakes) {
        assert!(!(mistake.kind == Kind::SenseReversed && mistake.at == "the input"), "{}", report.to_text());
    }
}

// --- digits ------------------------------------------------------------------------------------------------------------

#[test]
fn digits_of_persian_and_arabic_are_read() {
    let scene = offset_slider(FIND);
    let rows = "v(B),۵۷٫۴,,,in/s,,۰\nomega(۳),٣٫٣٩,,,rad/s,ccw,\na(B),۵۶۰,,,in/s^2,,۱۸۰\nalpha(3),١١٢٫٧,,,rad/s^2,ccw,\n";
    let report = tabled(&scene, rows).unwrap();
    assert_eq!(report.sum(), (5.0, 5.0), "{}", report.to_text());
    let text = "{ \"student\": \"گروه ۲\", \"values\": { \"v(B)\": \"۵۷٫۴ in/s\", \"omega(3)\": ۳.۳۹, \
                \"a(B)\": { \"magnitude\": \"٥٦٠\", \"direction\": ۱۸۰ }, \"alpha(3)\": 112.7 } }";
    let answers = read_answers(text, &scene).unwrap();
    assert_eq!(answers.student.as_deref(), Some("گروه ۲"));
    let report = grade(&scene, &answers, &GradeSettings::default()).unwrap();
    assert_eq!(report.sum(), (5.0, 5.0), "{}", report.to_text());
    // Thousands are parted by a sign of their own.
    let report = tabled(&slider_in_line(), "v(B),۱٬۲۷۸,,,mm/s,,۱۸۰\n").unwrap();
    assert_eq!(report.sum().0, 1.0, "{}", report.to_text());
}

#[test]
fn a_decimal_comma_is_named_as_such() {
    let scene = offset_slider(FIND);
    let told = tabled(&scene, "v(B),\"57,4\",,,in/s,,0\n").unwrap_err();
    assert!(told.contains("decimal comma") && told.contains("57.4"), "{told}");
    for text in
        [r#"{ "values": { "v(B)": "57,4 in/s" } }"#, r#"{ "values": { "v(B)": { "magnitude": "57,4" } } }"#]
    {
        let told = read_answers(text, &scene).unwrap_err().to_string();
        assert!(told.contains("decimal comma") && told.contains("57.4"), "{told}");
    }
    // Where semicolons part the fields it is the decimal sign.
    let answers = read_answers("quantity;value;unit;direction\nv(B);57,4;in/s;0\n", &scene).unwrap();
    assert!(grade(&scene, &answers, &GradeSettings::default()).unwrap().holds());
}
