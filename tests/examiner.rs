//! `grade` as an examiner: letters and marks, follow-through by other ways than the solution's, tolerances, reports.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::path::Path;
use std::process::Command;

use linkgram::grade::{
    Allowed, GradeError, GradeSettings, Kind, Report, Verdict, grade, grade_with_overlay, read_answers,
    tolerances,
};
use linkgram::scene::{self, Scene};
use serde_json::{Value, json};

use crate::common::hand_in::{Closed, SLIDER, graded, right as closed, slider};

fn verdict(report: &Report, name: &str) -> Verdict {
    report.quantities.iter().find(|q| q.name == name).unwrap_or_else(|| panic!("no {name}")).verdict
}

fn components(v: [f64; 2], unit: &str) -> Value {
    json!({ "components": [format!("{:.2} {unit}", v[0]), format!("{:.2} {unit}", v[1])] })
}

/// A drawing with marks (mm, y down) and letters of 4 mm in their places.
fn drawing(marks: &str, letters: &[(&str, f64, f64)]) -> String {
    let mut text = String::new();
    for (letter, x, y) in letters {
        // A letter's ink has its middle a third of its height above its line.
        let (x, y) = (x - 1.0 * letter.chars().count() as f64, y + 1.32);
        text += &format!(r#"<text x="{x}" y="{y}" font-size="4">{letter}</text>"#);
    }
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">{marks}{text}</svg>"#
    )
}

fn places(svg: &str) -> Result<Vec<(String, [f64; 2])>, String> {
    let answers = read_answers(svg, &slider()).map_err(|error| error.to_string())?;
    let points = answers.figures.iter().flat_map(|figure| &figure.points);
    Ok(points.map(|(name, at, _)| (name.clone(), [at[0].round(), -at[1].round()])).collect())
}

#[test]
fn letters_are_matched_one_to_one() {
    // A stands nearer to the dot of B than to its own; both together leave no doubt.
    let marks = r#"<circle cx="100" cy="100" r="0.5"/><circle cx="103" cy="100" r="0.5"/>"#;
    let found = places(&drawing(marks, &[("A", 101.8, 98.5), ("B", 103.8, 98.8)])).unwrap();
    assert_eq!(found, [("A".to_owned(), [100.0, 100.0]), ("B".to_owned(), [103.0, 100.0])]);
    // The corners of an arrowhead are no marks of their own, and a line that ends at its back ends at its tip.
    let arrow = r#"<line x1="20" y1="20" x2="57.5" y2="20"/><path d="M60,20 L57.5,19.2 L57.5,20.8 Z"/>"#;
    let found = places(&drawing(arrow, &[("o", 18.0, 18.5), ("b", 57.0, 17.5)])).unwrap();
    assert_eq!(found, [("o".to_owned(), [20.0, 20.0]), ("b".to_owned(), [60.0, 20.0])]);
    // The image of what stands still is the pole, and one text may name two points.
    let marks = r#"<circle cx="20" cy="20" r="0.5"/><circle cx="60" cy="20" r="0.5"/>"#;
    let found = places(&drawing(marks, &[("o2", 18.5, 18.0), ("a,b", 61.0, 18.0)])).unwrap();
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["o", "a", "b"]);
    assert_eq!(found[1].1, found[2].1);
}

#[test]
fn what_leaves_a_choice_is_told_and_not_guessed() {
    let dots = r#"<circle cx="100" cy="100" r="0.5"/><circle cx="106" cy="100" r="0.5"/>"#;
    let told = places(&drawing(dots, &[("A", 103.0, 100.0)])).unwrap_err();
    assert!(told.contains("as near to one mark as to another"), "{told}");
    let told = places(&drawing(dots, &[("A", 150.0, 100.0)])).unwrap_err();
    assert!(told.contains("nothing is marked beside the letter `A`"), "{told}");
    // Two letters and one mark: here A and B are two points.
    let marks = r#"<circle cx="20" cy="100" r="0.5"/><circle cx="100" cy="100" r="0.5"/>"#;
    let svg = drawing(marks, &[("O2", 20.0, 98.0), ("A", 98.5, 98.5), ("B", 101.5, 98.5)]);
    let answers = read_answers(&svg, &slider()).unwrap();
    match grade(&slider(), &answers, &GradeSettings::default()) {
        Err(GradeError::Answers(told)) => {
            assert!(told.to_string().contains("stand beside one mark"), "{told}")
        }
        other => panic!("{other:?}"),
    }
}

/// The tangential part is too long by a slip that nobody foresees; the acceleration is the sum of the student's own parts,
/// and no longer lies along the guide. The program's own way from there on is another one.
#[test]
fn a_sum_of_the_students_own_vectors_is_consistent() {
    let Closed { a, b, omega, alpha, .. } = closed();
    let d = [b[0] - a[0], b[1] - a[1]];
    let of_crank = [-100.0 * a[0], -100.0 * a[1]];
    let normal = [-omega * omega * d[0], -omega * omega * d[1]];
    let tangential = [-1.37 * alpha * d[1], 1.37 * alpha * d[0]];
    let sum = [of_crank[0] + normal[0] + tangential[0], of_crank[1] + normal[1] + tangential[1]];
    let answers = json!({ "values": {
        "a(A)": components(of_crank, "cm/s^2"), "an(B/A)": components(normal, "cm/s^2"),
        "at(B/A)": components(tangential, "cm/s^2"), "a(B)": components(sum, "cm/s^2"),
        "alpha(3)": format!("{:.2} rad/s^2 ccw", 1.37 * alpha) } });
    let report = graded(&slider(), &answers);
    assert_eq!(verdict(&report, "an(B/A)"), Verdict::Right, "{}", report.to_text());
    assert_eq!(verdict(&report, "at(B/A)"), Verdict::Wrong, "{}", report.to_text());
    assert_eq!(verdict(&report, "a(B)"), Verdict::Consistent, "{}", report.to_text());
    assert_eq!(verdict(&report, "alpha(3)"), Verdict::Consistent, "{}", report.to_text());
}

fn example(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name);
    scene::read(&std::fs::read_to_string(&path).unwrap(), name).unwrap()
}

/// ω₄ from the pin C (30 cm from its pivot), where the solution takes B.
#[test]
fn a_rate_from_another_point_of_the_link_is_consistent() {
    let scene = example("s000-ch3a-1.json");
    let answers = json!({ "values": { "v(B)": "175 cm/s", "v(C)": "240 cm/s", "omega(4)": "8 rad/s ccw" } });
    let report = graded(&scene, &answers);
    assert_eq!(verdict(&report, "v(B)"), Verdict::Right, "{}", report.to_text());
    let both = [verdict(&report, "v(C)"), verdict(&report, "omega(4)")];
    assert!(both.contains(&Verdict::Wrong) && both.contains(&Verdict::Consistent), "{}", report.to_text());
    // Without the velocity from which it came it is a fault of its own.
    let answers = json!({ "values": { "v(B)": "175 cm/s", "v(C)": "175 cm/s", "omega(4)": "8 rad/s ccw" } });
    assert_eq!(verdict(&graded(&scene, &answers), "omega(4)"), Verdict::Wrong);
}

#[test]
fn calculated_values_are_judged_as_calculated() {
    // 300 cm/s by ωl, 3000 cm/s² by ω²l.
    for (given, expected) in
        [("300 cm/s", Verdict::Right), ("300.9 cm/s", Verdict::Right), ("304 cm/s", Verdict::Wrong)]
    {
        let report = graded(&slider(), &json!({ "values": { "v(A)": given } }));
        assert_eq!(verdict(&report, "v(A)"), expected, "{given}");
        assert_eq!(report.quantities[0].allowed, Allowed::Calculated);
    }
    let tilted =
        |degrees: f64| json!({ "values": { "v(A)": { "magnitude": "300 cm/s", "direction": degrees } } });
    assert_eq!(verdict(&graded(&slider(), &tilted(150.8)), "v(A)"), Verdict::Right);
    assert_eq!(verdict(&graded(&slider(), &tilted(153.0)), "v(A)"), Verdict::Wrong);
    // Measured on paper it is a reading.
    let report = graded(&slider(), &json!({ "values": { "v(B)": "351 cm/s" } }));
    assert!(matches!(report.quantities[0].allowed, Allowed::Read { mm: Some(_), of: Some(_) }));
}

#[test]
fn tolerances_are_capped_and_loose_results_flagged_beforehand() {
    let scene = slider();
    let strict = GradeSettings { max_tolerance: 0.005, ..GradeSettings::default() };
    let all = tolerances(&scene, &strict).unwrap();
    assert_eq!(all.len(), scene.mechanism.asked.len());
    let of = |name: &str| all.iter().find(|graded| graded.name == name).unwrap();
    assert!(matches!(of("omega(3)").allowed, Allowed::Capped { .. }), "{:?}", of("omega(3)"));
    assert!(of("omega(3)").tolerance <= 0.0051 * closed().omega.abs());
    // Half a degree of a protractor and two tenths of a millimetre leave ω₃ open by some percent.
    let usual = tolerances(&scene, &GradeSettings::default()).unwrap();
    let omega = usual.iter().find(|graded| graded.name == "omega(3)").unwrap();
    assert!(!matches!(omega.allowed, Allowed::Capped { .. }), "{omega:?}");
    // A cap holds for the answers: 3 % off is right by the usual tolerance and wrong by the strict one.
    let answers = json!({ "values": { "omega(3)": format!("{:.3} rad/s cw", 1.03 * closed().omega.abs()) } });
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let judged = |settings: &GradeSettings| grade(&scene, &answers, settings).unwrap().quantities[0].verdict;
    assert_eq!(judged(&GradeSettings::default()), Verdict::Right);
    assert_eq!(judged(&strict), Verdict::Wrong);
}

#[test]
fn a_report_speaks_as_the_student_wrote() {
    let Closed { omega, alpha, .. } = closed();
    let answers = json!({ "student": "Ada", "values": {
        "v(B)": { "magnitude": "351 cm/s", "direction": "180 deg" }, "omega(3)": format!("{:.2} rad/s cw", omega.abs()),
        "alpha(3)": format!("{alpha:.1} rad/s^2 cw") } });
    let report = graded(&slider(), &answers);
    let text = report.to_text();
    assert!(text.contains("351 cm/s at 180°"), "{text}");
    assert!(text.contains("Probably α₃: the opposite sense"), "{text}");
    assert!(text.contains("not answered"), "{text}");
    // What is asked and not answered brings no marks, and is counted.
    assert_eq!(report.missing, [("a(B)".to_owned(), 3.0)]);
    assert_eq!(report.sum(), (2.0, 6.0));
    // No line is longer than what a tolerance leaves of its digits.
    let long = |word: &str| word.trim_matches(|c: char| !c.is_ascii_digit()).len() > 8;
    assert!(!text.split_whitespace().any(long), "{text}");
    let page = report.to_html("Slider <crank>", Some("<?xml?><svg></svg>"));
    assert!(page.contains("Slider &lt;crank&gt;") && page.contains("<figure>\n<svg></svg>"), "{page}");
    assert!(page.contains("2 of 6 marks"), "{page}");
}

#[test]
fn a_calculator_in_radians_is_named_once() {
    // sin and cos of 150 and 180, taken as radians.
    let spoilt =
        |size: f64, degrees: f64, unit| components([size * degrees.cos(), size * degrees.sin()], unit);
    let answers = json!({ "values": { "v(A)": spoilt(300.0, 150.0, "cm/s"), "v(B)": spoilt(351.0, 180.0, "cm/s"),
                                      "a(B)": spoilt(641.0, 180.0, "cm/s^2") } });
    let report = graded(&slider(), &answers);
    let named: Vec<Kind> =
        report.quantities.iter().filter_map(|q| q.mistakes.first()).map(|m| m.kind).collect();
    assert_eq!(named, [Kind::CalculatorInRadians], "{}", report.to_text());
}

#[test]
fn every_fault_is_circled_where_the_student_has_it() {
    let scene = slider();
    let answers = json!({ "values": { "v(B)": { "magnitude": "150 cm/s", "direction": "180 deg" } } });
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let (_, figure) = grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
    let (mut circle, mut lines) = (None, Vec::new());
    figure.unwrap().root.walk(&mut |node| {
        use linkgram::sheet::figure::{Node, Shape};
        let Node::Mark(mark) = node else { return };
        match (&mark.shape, mark.class) {
            (Shape::Circle { centre, .. }, "fault") => circle = Some(*centre),
            (Shape::Line(from, to), "student") => lines.push((*from, *to)),
            _ => {}
        }
    });
    let circle = circle.unwrap();
    // To the left, and shorter than the right one: 150 of 351 cm/s at the sheet's scale (2.5 cm/s to the millimetre).
    let own = |(tail, head): &&(kurbo::Point, kurbo::Point)| {
        (head.x - tail.x + 150.0 / 2.5).abs() < 1e-6 && (head.y - tail.y).abs() < 1e-6
    };
    let (_, head) = lines.iter().find(own).unwrap_or_else(|| panic!("{lines:?}"));
    assert!(circle.distance(*head) < 1e-6, "the circle is about the head of the student's vector");
}

struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-examiner-{}-{name}", std::process::id()));
        std::fs::create_dir_all(path.join("answers")).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_class_is_graded_in_one_call() {
    let folder = Folder::new("class");
    std::fs::write(folder.0.join("scene.json"), SLIDER).unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.0.join("answers").join(name), text).unwrap();
    put(
        "ada.json",
        r#"{ "student": "Ada, A.", "values": { "v(B)": "351 cm/s", "omega(3)": "3.51 rad/s cw" } }"#,
    );
    put("bob.json", r#"{ "student": "=Bob", "values": { "omega(3)": "3.51 rad/s ccw" } }"#);
    put("eve.csv", "quantity,value,unit,sense\nomega(3),3.51,rad/s,ccw\n");
    let run = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).current_dir(&folder.0).output().unwrap()
    };
    let output = run(&[
        "grade",
        "scene.json",
        "answers/ada.json",
        "answers/bob.json",
        "answers/eve.csv",
        "-o",
        "reports/",
    ]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("2 students: ω₃: the opposite sense"), "{said}");
    let read = |name: &str| std::fs::read_to_string(folder.0.join("reports").join(name)).unwrap();
    let marks = read("marks.csv");
    let lines: Vec<&str> = marks.lines().collect();
    assert_eq!(lines.len(), 4, "{marks}");
    assert!(lines[1].contains("\"Ada, A.\",2,6,33.3"), "{marks}");
    assert!(lines[2].contains("'=Bob,0,6,0.0,omega(3),sense-reversed"), "{marks}");
    assert!(read("faults.csv").starts_with("students,mistake,at,text\n2,sense-reversed,omega(3),"));
    for page in ["ada.html", "bob.html", "eve.html"] {
        assert!(read(page).starts_with("<!DOCTYPE html>"), "{page}");
    }
    // An empty sheet has no marks; a table of a spreadsheet with decimal commas is read.
    put("nil.csv", "student;Nil\nquantity;value;unit;sense\nomega(3);;rad/s;\n");
    put("pol.csv", "student;Pol\nquantity;value;unit;sense\nomega(3);3,51;rad/s;cw\n");
    let output = run(&["grade", "scene.json", "answers/nil.csv", "answers/pol.csv"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(
        said.contains("Nil (answers/nil.csv)      0 of 6")
            && said.contains("Pol (answers/pol.csv)      1 of 6"),
        "{said}"
    );
    // One that cannot be read is told, and the others are graded all the same.
    put("mal.json", r#"{ "values": { "v(Q)": 3 } }"#);
    let output = run(&["grade", "scene.json", "answers/ada.json", "answers/mal.json", "-o", "again/"]);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("answers/mal.json:1:") && told.contains("there is no point `Q`"), "{told}");
    let marks = std::fs::read_to_string(folder.0.join("again/marks.csv")).unwrap();
    assert!(marks.contains("not graded") && folder.0.join("again/ada.html").exists(), "{marks}");
    // Before anybody answers: by how much each answer may be off.
    let output = run(&["grade", "scene.json", "--max-tolerance", "1%"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.lines().count() == 4 && said.contains("TOO LOOSE"), "{said}");
    // Several have a folder, and no answers no overlay.
    for arguments in [
        &["grade", "scene.json", "answers/ada.json", "answers/bob.json", "-o", "x.svg"][..],
        &["grade", "scene.json", "-o", "x.svg"],
        &["grade", "scene.json", "answers/ada.json", "-o", "x.txt"],
    ] {
        assert_eq!(run(arguments).status.code(), Some(2), "{arguments:?}");
    }
}
