//! A course: one rule of tolerances for keys and grading, reports that a student understands, drawings that lie askew,
//! mistakes of a classroom by their names, questions that say how their answers count.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::path::Path;
use std::process::Command;

use linkgram::exam::{self, KeyAnswer, Loose, Terms};
use linkgram::grade::{GradeSettings, Kind, Report, Verdict, tolerances};
use linkgram::scene::{self, Scene};
use linkgram::sheet::{Language, Part};
use serde_json::{Map, Value, json};

use crate::common::hand_in::{self, Closed, SLIDER, graded};

/// The slider-crank with marks of this course.
fn marked() -> String {
    SLIDER.replace(r#""a(B)": 3"#, r#""a(B)": 4, "alpha(3)": 2"#)
}

fn slider() -> Scene {
    scene::read(&marked(), "slider.json").unwrap()
}

fn example(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name);
    scene::read(&std::fs::read_to_string(&path).unwrap(), name).unwrap()
}

fn of<'r>(report: &'r Report, name: &str) -> &'r linkgram::grade::Graded {
    report.quantities.iter().find(|q| q.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn first_kind(report: &Report) -> Option<Kind> {
    report.first_fault()?.mistakes.first().map(|mistake| mistake.kind)
}

/// The slider-crank by its closed forms, cm and s: v(B), ω₃, a(B), ε₃ along the guide.
fn closed() -> [f64; 4] {
    let Closed { speed, omega, acceleration, alpha, .. } = hand_in::right();
    [speed, omega, acceleration, alpha]
}

#[test]
fn magnitude_and_direction_have_their_own_tolerances_and_are_told_apart() {
    let [v, ..] = closed();
    let one = |size: f64, degrees: f64| {
        let answers =
            json!({ "values": { "v(B)": { "magnitude": format!("{size:.2} cm/s"), "direction": degrees } } });
        let report = graded(&slider(), &answers);
        let told = report.to_text();
        let graded = of(&report, "v(B)");
        (graded.verdict, graded.amiss.size, graded.amiss.direction, told)
    };
    // Five degrees are a twelfth of the vector, and more than a hand misses; its length says nothing of that.
    let (verdict, size, direction, told) = one(-v, 185.0);
    assert_eq!((verdict, size, direction), (Verdict::Wrong, false, true), "{told}");
    assert!(told.contains("wrong in the direction: 351 ± ") && told.contains("at 180° ± "), "{told}");
    let (verdict, size, direction, told) = one(-0.9 * v, 180.0);
    assert_eq!((verdict, size, direction), (Verdict::Wrong, true, false), "{told}");
    assert!(told.contains("wrong in the magnitude"), "{told}");
    let (verdict, size, direction, told) = one(-0.9 * v, 185.0);
    assert_eq!((verdict, size, direction), (Verdict::Wrong, true, true), "{told}");
    assert!(told.contains("wrong in magnitude and direction"), "{told}");
    assert_eq!(one(-v, 180.3).0, Verdict::Right);
}

fn terms(loose: Loose) -> Terms {
    hand_in::terms(2, 3, loose)
}

/// A hand-in of the key's own numbers, one of them off by so many of its tolerances.
fn handed_in(answers: &[KeyAnswer], amiss: usize, by: f64) -> Value {
    let mut values = Map::new();
    for (index, answer) in answers.iter().enumerate() {
        let value = answer.value + if index == amiss { by * answer.tolerance } else { 0.0 };
        let entry = values.entry(answer.name.clone()).or_insert_with(|| json!({}));
        let with_unit = |value: f64| json!(format!("{value:.9e} {}", answer.unit));
        match answer.part {
            Part::Value => *entry = with_unit(value),
            Part::Magnitude => entry["magnitude"] = with_unit(value),
            Part::Direction => entry["direction"] = json!(value),
            Part::X | Part::Y => {
                let other = |entry: &Value, k: usize| entry["components"][k].clone();
                let (x, y) = match answer.part {
                    Part::X => (with_unit(value), other(entry, 1)),
                    _ => (other(entry, 0), with_unit(value)),
                };
                *entry = json!({ "components": [x, y] });
            }
        }
    }
    json!({ "values": values })
}

/// What the key of an exam accepts the grader accepts, and what it refuses he refuses: of every number of every variant.
#[test]
fn the_key_and_the_grader_have_one_rule() {
    let mut tried = 0;
    for name in [
        "crank-and-slider",
        "quick-return",
        "six-link-slider",
        "four-bar-forces",
        "rough-slider-crank",
        "flywheel",
    ] {
        let scene = example(&format!("exam/{name}.json"));
        let drawn = exam::draw(&scene, &terms(Loose::Ask), 2, &|_| {}).unwrap();
        for variant in &drawn.variants {
            for (index, answer) in variant.answers.iter().enumerate() {
                for (by, accepted) in [(0.98, true), (-0.98, true), (1.02, false), (-1.02, false)] {
                    // A direction that may be any is right whatever it is.
                    let any = answer.part == Part::Direction && answer.tolerance >= 180.0;
                    // Beyond the cap nobody loses a mark for what no careful hand can measure.
                    if answer.loose.is_some() && !accepted {
                        continue;
                    }
                    let report = graded(&variant.scene, &handed_in(&variant.answers, index, by));
                    let right = of(&report, &answer.name).verdict == Verdict::Right;
                    let told = report.to_text();
                    assert_eq!(right, accepted || any, "{name} {answer:?} off by {by}\n{told}");
                    tried += 1;
                }
            }
        }
    }
    assert!(tried > 200, "{tried}");
}

/// Cranks that are nearly parallel: the centre of the coupler lies far off, where their lines cross flatly.
#[test]
fn a_centre_is_capped_as_everything_else() {
    let scene = scene::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
            "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 90 },
                       "4": { "joins": ["O4", "B"], "length": 70 } },
            "near": { "B": [120, 68] }, "input": { "link": 2, "angle": 78, "omega": "10 rad/s ccw" },
            "find": ["I(1,3)", "x(A)"] }"#,
        "far.json",
    )
    .unwrap();
    let strict = GradeSettings { max_tolerance: 0.01, ..GradeSettings::default() };
    let all = tolerances(&scene, &strict).unwrap();
    let centre = all.iter().find(|graded| graded.name == "I(1,3)").unwrap();
    let [x, y] = centre.right[..] else { panic!("{centre:?}") };
    let far = libm::hypot(x, y).min(libm::hypot(x - 100.0, y));
    assert!(centre.tolerance <= 0.01 * far + 1e-9, "{centre:?}");
    assert!(matches!(centre.allowed, linkgram::grade::Allowed::Capped { .. }), "{centre:?}");
    // A pin is read to half a millimetre or so, wherever the origin is.
    let pin = all.iter().find(|graded| graded.name == "x(A)").unwrap();
    assert!(pin.tolerance < 2.0 && matches!(pin.allowed, linkgram::grade::Allowed::Read { .. }), "{pin:?}");
}

/// What a careful hand cannot measure: passed over, left out with its marks, or asked and flagged.
#[test]
fn what_cannot_be_measured_is_not_asked_unawares() {
    let scene = example("exam/quick-return.json");
    let loose = |answers: &[KeyAnswer]| answers.iter().any(|answer| answer.loose.is_some());
    let drawn = exam::draw(&scene, &terms(Loose::PassOver), 2, &|_| {}).unwrap();
    assert!(drawn.variants.iter().all(|variant| !loose(&variant.answers)));
    // alpha(4) of the scene itself is small beside what its polygon is made of.
    let (less, names) = exam::without_loose(&scene, &terms(Loose::LeaveOut)).unwrap().unwrap();
    assert_eq!(names, ["alpha(4)"]);
    let asked: Vec<&str> = less.mechanism.asked.iter().map(|asked| asked.name.as_str()).collect();
    assert_eq!(asked, ["omega(4)", "slip(A/4)", "v(C)", "coriolis(A/4)", "a(C)"]);
    assert_eq!(less.vary.len(), scene.vary.len());
    let drawn = exam::draw(&scene, &Terms { variants: 6, ..terms(Loose::Ask) }, 2, &|_| {}).unwrap();
    assert!(drawn.variants.iter().any(|variant| loose(&variant.answers)));
    let key = exam::csv(&drawn.variants);
    assert!(key.lines().next().unwrap().ends_with(",marks,measurable"), "{key}");
    let flagged = key.lines().filter(|line| line.contains(",no: ± ")).count();
    let expected: usize =
        drawn.variants.iter().flat_map(|v| &v.answers).filter(|answer| answer.loose.is_some()).count();
    assert_eq!(flagged, expected, "{key}");
    // Marks of what is left out go with it.
    let marked = marked().replace(
        "\"find\"",
        "\"vary\": { \"input.angle\": { \"from\": 50, \"to\": 70, \"step\": 5 } }, \"find\"",
    );
    let marked = scene::read(&marked, "marked.json").unwrap();
    let less = scene::read(&scene::asking_less(&marked, &["a(B)".to_owned()]), "less.json").unwrap();
    assert_eq!(less.sheet.marks, [("alpha(3)".to_owned(), 2.0)]);
}

/// The slider-crank as a drawing, its figures turned by some degrees; `long` is what b′ is too far out, mm.
fn drawn(turned: [f64; 3], with_skeleton: bool, long: f64) -> Value {
    let (r, w, at): (f64, f64, f64) = (30.0, 10.0, 60_f64.to_radians());
    let [v, omega, a, _] = closed();
    let pin = [r * at.cos(), r * at.sin()];
    let slider = [pin[0] + (2500.0 - pin[1] * pin[1]).sqrt(), 0.0];
    let d = [slider[0] - pin[0], -pin[1]];
    let normal = [-w * w * pin[0] - omega * omega * d[0], -w * w * pin[1] - omega * omega * d[1]];
    let place = |[x, y]: [f64; 2], scale: f64, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        json!([80.0 + scale * (cos * x - sin * y), 90.0 + scale * (sin * x + cos * y)])
    };
    let [skeleton, velocity, acceleration] = turned;
    // 1:10; 5 cm/s and 30 cm/s² to the millimetre.
    let (of_v, of_a) = (1.0 / 5.0, 1.0 / 30.0);
    let mut points = json!({
        "velocity": { "o": place([0.0; 2], of_v, velocity),
                      "a": place([-w * pin[1], w * pin[0]], of_v, velocity), "b": place([v, 0.0], of_v, velocity) },
        "acceleration": { "o'": place([0.0; 2], of_a, acceleration),
                          "a'": place([-w * w * pin[0], -w * w * pin[1]], of_a, acceleration),
                          "b'1": place(normal, of_a, acceleration),
                          "b'": place([a + 30.0 * long, 0.0], of_a, acceleration) },
    });
    if with_skeleton {
        points["skeleton"] = json!({ "O2": place([0.0; 2], 1.0, skeleton), "A": place(pin, 1.0, skeleton),
                                     "B": place(slider, 1.0, skeleton) });
    }
    json!({ "points": points,
            "scales": { "length": "1:10", "velocity": "5 cm/s per mm", "acceleration": "30 cm/s^2 per mm" } })
}

#[test]
fn a_sheet_that_lies_turned_is_named_and_its_drawing_graded() {
    for (turned, with_skeleton) in [(7.0, true), (-12.0, true), (90.0, true), (7.0, false)] {
        let report = graded(&slider(), &drawn([turned; 3], with_skeleton, 0.0));
        assert!(report.holds(), "{}", report.to_text());
        assert!((report.turned.unwrap() - turned).abs() < 0.2, "{:?}", report.turned);
        assert!(report.to_text().contains("Your drawing lies turned by"), "{}", report.to_text());
        // Relative to it a fault is a fault, and the only one.
        let report = graded(&slider(), &drawn([turned; 3], with_skeleton, 9.0));
        let wrong: Vec<&str> = report
            .quantities
            .iter()
            .filter(|graded| graded.verdict != Verdict::Right)
            .map(|graded| graded.name.as_str())
            .collect();
        assert_eq!(wrong, ["acceleration:b'"], "{}", report.to_text());
    }
    assert_eq!(graded(&slider(), &drawn([0.0; 3], true, 0.0)).turned, None);
    // One polygon that is turned against the skeleton is drawn wrongly, and what hangs on it follows.
    for (turned, at) in
        [([0.0, 9.0, 0.0], "the velocity polygon"), ([0.0, 0.0, -9.0], "the acceleration polygon")]
    {
        let report = graded(&slider(), &drawn(turned, true, 0.0));
        let mistake = &report.first_fault().unwrap().mistakes[0];
        assert_eq!((mistake.kind, &*mistake.at), (Kind::FigureTurned, at), "{}", report.to_text());
        let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).count();
        assert_eq!(wrong, 1, "{}", report.to_text());
    }
}

/// P = T ω and I = E / (K ω²) − I₀ by hand: 47.5 N m at 300 rpm, with what turns already 0.45 kg m².
#[test]
fn revolutions_per_minute_are_known_in_turning_moments() {
    let scene = example("exam/flywheel.json");
    let fluctuation = 643.2607;
    let power = |omega: f64| format!("{:.4} W", 47.5 * omega);
    let wheel = |omega: f64| format!("{:.4} kg*m^2", fluctuation / (0.03 * omega * omega) - 0.45);
    let (rad, rps) = (300.0 * std::f64::consts::PI / 30.0, 5.0);
    for (values, kind) in [
        (json!({ "power": power(300.0) }), Kind::RpmAsRad),
        (json!({ "power": power(300.0), "If": wheel(300.0) }), Kind::RpmAsRad),
        (json!({ "power": power(rad), "If": wheel(300.0) }), Kind::RpmAsRad),
        (json!({ "power": power(300.0), "If": wheel(rad) }), Kind::RpmAsRad),
        (json!({ "power": power(rps), "If": wheel(rps) }), Kind::RevAsRad),
    ] {
        let report = graded(&scene, &json!({ "values": values }));
        assert_eq!(first_kind(&report), Some(kind), "{values}\n{}", report.to_text());
        let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).count();
        assert_eq!(wrong, 1, "{}", report.to_text());
    }
    assert!(graded(&scene, &json!({ "values": { "power": power(rad), "If": wheel(rad) } })).holds());
}

/// A press: 300 N m drive it all the time, 1200 N m are wanted from 120° to 180°, with ramps of 30° beside. What is above the
/// mean is a trapezium of 900 N m, 60° above and 105° below. Whoever draws both curves knows that their areas are one.
#[test]
fn a_press_under_a_constant_torque_can_be_drawn_by_hand() {
    let scene = scene::read(
        r#"{ "units": { "torque": "N*m" }, "links": {}, "input": { "omega": "180 rpm" },
            "cycle": { "torque": { "table": [[0, 300], [360, 300]] },
                       "load": { "table": [[0, 0], [90, 0], [120, 1200], [180, 1200], [210, 0], [360, 0]] },
                       "period": 360, "fluctuation": 0.04 },
            "find": ["Ef", "If"],
            "vary": { "cycle.fluctuation": { "from": 0.02, "to": 0.06, "step": 0.01 } } }"#,
        "press.json",
    )
    .unwrap();
    let drawn = exam::draw(&scene, &terms(Loose::PassOver), 2, &|_| {}).unwrap();
    let area = 900.0 * 82.5_f64.to_radians();
    for variant in &drawn.variants {
        let energy = &variant.answers[0];
        assert!((energy.value - area).abs() < 1e-6 * area && energy.tolerance < 0.05 * area, "{energy:?}");
    }
}

#[test]
fn a_scale_that_was_applied_twice_is_named() {
    let [v, _, a, _] = closed();
    let scales = json!({ "velocity": "4 cm/s per mm", "acceleration": "25 cm/s^2 per mm" });
    // By what a millimetre is, and by what a centimetre is.
    for factor in [1.0, 10.0] {
        let values = json!({ "v(B)": format!("{:.2} cm/s", -v * 4.0 * factor) });
        let report = graded(&slider(), &json!({ "values": values, "scales": scales }));
        assert_eq!(first_kind(&report), Some(Kind::ScaleTwice), "{}", report.to_text());
        let values = json!({ "a(B)": format!("{:.2} cm/s^2", a.abs() * 25.0 * factor) });
        let report = graded(&slider(), &json!({ "values": values, "scales": scales }));
        assert_eq!(first_kind(&report), Some(Kind::ScaleTwice), "{}", report.to_text());
    }
}

/// 2·ω₄·V by the numbers of the sheet (2.13 rad/s, 43.2 mm/s: 184 mm/s²), written down without its 2; the rest is right.
#[test]
fn a_number_that_was_only_written_down_wrongly_has_its_name() {
    let scene = example("exam/quick-return.json");
    let right = tolerances(&scene, &GradeSettings::default()).unwrap();
    let of = |name: &str| right.iter().find(|graded| graded.name == name).unwrap().right.clone();
    let (coriolis, slider) = (of("coriolis(A/4)"), of("a(C)"));
    let components = |v: &[f64], factor: f64| json!({ "components": [factor * v[0], factor * v[1]] });
    let answers = json!({ "values": { "coriolis(A/4)": components(&coriolis, 0.5), "a(C)": components(&slider, 1.0) } });
    let report = graded(&scene, &answers);
    assert_eq!(first_kind(&report), Some(Kind::CoriolisWithoutTwo), "{}", report.to_text());
    assert_eq!(of_report(&report, "a(C)"), Verdict::Right, "{}", report.to_text());
}

fn of_report(report: &Report, name: &str) -> Verdict {
    of(report, name).verdict
}

#[test]
fn a_student_reads_the_names_of_his_textbook() {
    let [v, ..] = closed();
    let answers = json!({ "values": { "v(B)": format!("{:.2} cm/s", -v), "omega(3)": "3.51 rad/s ccw" },
                          "points": drawn([0.0; 3], true, 9.0)["points"],
                          "scales": { "length": "1:10", "velocity": "5 cm/s per mm", "acceleration": "30 cm/s^2 per mm" } });
    let report = graded(&slider(), &answers);
    let (text, page) = (report.to_text(), report.to_html("Slider-crank", None));
    for raw in ["omega(3)", "alpha(3)", "v(B)", "acceleration:", "b'1"] {
        assert!(!text.contains(raw) && !page.contains(raw), "{raw}\n{text}\n{page}");
    }
    assert!(
        text.contains("ω₃") && text.contains("V_B") && text.contains("b′₁ (acceleration polygon)"),
        "{text}"
    );
    assert!(page.contains("<i>ω</i><sub>3</sub>"), "{page}");
}

fn texts(figure: &linkgram::sheet::Figure) -> String {
    let mut all = String::new();
    figure.root.walk(&mut |node| {
        if let linkgram::sheet::figure::Node::Text(text) = node {
            text.runs.iter().for_each(|run| all.push_str(&run.text));
            all.push(' ');
        }
    });
    all
}

/// V along the guide has a quarter of its marks for the sense that is left to choose: 4 are 3 and 1.
#[test]
fn a_question_says_how_its_answers_count() {
    let told = texts(&exam::question(&slider(), Language::English).unwrap());
    for wanted in [
        "directions in degrees, counter-clockwise from the x-axis",
        "rotations and torques counter-clockwise positive",
        "4 (3 for the magnitude, 1 for the direction)",
        "8 in all",
    ] {
        assert!(told.contains(wanted), "{wanted}\n{told}");
    }
    for tag in ["ar", "ar-x-ajala", "fa"] {
        let language = Language::from_tag(tag).unwrap();
        let own = texts(&exam::question(&slider(), language).unwrap());
        let words = if tag == "fa" {
            "پادساعتگرد از محور"
        } else {
            "عقارب الساعة من المحور"
        };
        assert!(own.contains(words), "{tag}\n{own}");
    }
    // A flywheel has no directions.
    let told = texts(&exam::question(&example("exam/flywheel.json"), Language::English).unwrap());
    assert!(!told.contains("directions") && told.contains("6 in all"), "{told}");
}

struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-classroom-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn program(&self, arguments: &[&str]) -> (Option<i32>, String, String) {
        let output = Command::new(env!("CARGO_BIN_EXE_linkgram"))
            .args(arguments)
            .current_dir(&self.0)
            .output()
            .unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    }

    fn read(&self, path: &str) -> String {
        std::fs::read_to_string(self.0.join(path)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Programs that know no embedded typefaces set formulas in others, over each other: what is printed is outlined. The
/// grader takes hand and cap from the exam, and gives the part that is right its marks as the key does.
#[test]
fn an_exam_is_printed_anywhere_and_graded_as_its_key() {
    let folder = Folder::new("printed");
    let scene = example("exam/crank-and-slider.json").source.text().to_owned();
    std::fs::write(folder.0.join("scene.json"), scene).unwrap();
    let (code, _, err) =
        folder.program(&["exam", "scene.json", "--variants", "1", "--max-tolerance", "20%", "-o", "exam"]);
    assert_eq!(code, Some(0), "{err}");
    #[cfg(feature = "png")]
    for sheet in ["answer-sheet.en.svg", "questions/001.en.svg", "solutions/001.en.svg"] {
        let svg = folder.read(&format!("exam/{sheet}"));
        assert!(!svg.contains("<text") && svg.contains("<path"), "{sheet}");
    }
    assert!(folder.read("exam/moodle-cloze.en.xml").contains("<![CDATA["));
    let key: Vec<Vec<String>> = folder
        .read("exam/key.csv")
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(str::to_owned).collect())
        .collect();
    let of = |part: &str| key.iter().find(|line| line[1] == "v(B)" && line[2] == part).unwrap();
    let (size, direction) = (of("magnitude"), of("direction"));
    let size_of: f64 = size[4].parse().unwrap();
    let turned: f64 = direction[4].parse::<f64>().unwrap() + 40.0;
    let answers = json!({ "variant": "001", "values": { "v(B)": { "magnitude": format!("{size_of} {}", size[3]), "direction": turned } } });
    std::fs::write(folder.0.join("ada.json"), answers.to_string()).unwrap();
    let (code, out, _) = folder.program(&["grade", "exam", "ada.json", "--json"]);
    let told: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(code, Some(1), "{out}");
    let graded = &told["quantities"][0];
    assert_eq!(graded["wrong_in"], json!(["direction"]), "{out}");
    assert_eq!(graded["marks"]["reached"].as_f64().unwrap(), size[6].parse::<f64>().unwrap(), "{out}");
    let tolerance = graded["tolerance"].as_f64().unwrap();
    assert!((tolerance - size[5].parse::<f64>().unwrap()).abs() < 1e-6 * tolerance, "{out}");
}

/// A crank that turns clockwise passes its places from the largest angle down: everything is told in that order.
#[test]
fn a_clockwise_crank_is_swept_as_it_turns() {
    let folder = Folder::new("swept");
    std::fs::write(folder.0.join("cw.json"), SLIDER.replace("ccw", "cw")).unwrap();
    std::fs::write(folder.0.join("ccw.json"), SLIDER).unwrap();
    let places = |text: &str| -> Vec<f64> {
        let events = text.lines().filter(|line| line.contains("least") || line.contains("greatest"));
        events.map(|line| line.split(' ').next().unwrap().parse().unwrap()).collect()
    };
    let (_, back, _) = folder.program(&["sweep", "cw.json"]);
    assert!(back.starts_with("angle of link 2 from 360 deg down to 0 deg (it turns clockwise)"), "{back}");
    assert!(back.contains("moves from 360 deg to 0 deg"), "{back}");
    assert!(places(&back).is_sorted_by(|a, b| a >= b), "{back}");
    let (_, forth, _) = folder.program(&["sweep", "ccw.json"]);
    assert!(forth.starts_with("angle of link 2 from 0 deg to 360 deg;"), "{forth}");
    assert!(places(&forth).is_sorted(), "{forth}");
    assert_eq!(folder.program(&["sweep", "cw.json", "-o", "cw.svg"]).0, Some(0));
    assert!(folder.read("cw.svg").contains("read from right to left"));
}

/// A problem in which no variant can be measured closely enough makes no exam only where that was asked for.
#[test]
fn an_exam_of_what_is_hard_to_measure_is_flagged_and_given() {
    let folder = Folder::new("loose");
    let scene = example("exam/crank-and-slider.json").source.text().to_owned();
    std::fs::write(folder.0.join("scene.json"), scene).unwrap();
    let exam = |more: &[&str]| {
        let asked = ["exam", "scene.json", "--variants", "2", "--max-tolerance", "0.05%"];
        folder.program(&[&asked[..], more].concat())
    };
    let (code, _, err) = exam(&["--loose", "pass-over", "-o", "strict"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(err.contains("--loose ask") && !folder.0.join("strict").exists(), "{err}");
    let (code, out, err) = exam(&["-o", "given"]);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains("asked all the same") && out.contains("flagged: "), "{out}");
    assert!(folder.read("given/key.csv").contains(",no: ± "));
    let again = exam(&["-o", "given"]);
    assert_eq!(again.0, Some(0), "{}", again.2);
}
