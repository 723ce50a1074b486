//! What a lecturer would not have handed out: feet by another's letters, lines that nobody drew, names that other answers
//! contradict. Four-bars and a quick return by equations of the test's own.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use linkgram::grade::{GradeSettings, Kind, Report, Verdict, grade_with_overlay, read_answers};
use linkgram::scene::{self, Scene};
use linkgram::sheet::Figure;
use linkgram::sheet::figure::{Dash, Node, Shape};
use serde_json::{Map, Value, json};

use crate::common::hand_in::graded;
use crate::common::plane::{Xy, cross, long, minus, plus, times, turned, unit};

fn read(text: &Value) -> Scene {
    scene::read(&text.to_string(), "scene.json").unwrap()
}

fn both(scene: &Scene, answers: &Value) -> (Report, Figure) {
    let answers = read_answers(&answers.to_string(), scene).unwrap();
    let (report, figure) = grade_with_overlay(scene, &answers, &GradeSettings::default()).unwrap();
    (report, figure.unwrap())
}

fn wrong(report: &Report) -> Vec<&str> {
    let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong);
    wrong.map(|graded| graded.name.as_str()).collect()
}

fn first_kind(report: &Report) -> Option<Kind> {
    report.first_fault()?.mistakes.first().map(|mistake| mistake.kind)
}

/// Where two lines meet.
fn meet(p: Xy, d: Xy, q: Xy, e: Xy) -> Xy {
    plus(p, times(d, cross(minus(q, p), e) / cross(d, e)))
}

fn square(r: Xy) -> Xy {
    [-r[1], r[0]]
}

/// mm and s; the scales make a millimetre of paper of 1 mm, 5 mm/s and 50 mm/s².
struct FourBar {
    a: Xy,
    b: Xy,
    pivot: Xy,
    alpha: f64,
}

/// ω of the crank.
const OMEGA: f64 = 10.0;

/// What somebody drew: points in mm of paper.
struct Drawing {
    velocity: Vec<(&'static str, Xy)>,
    acceleration: Vec<(&'static str, Xy)>,
}

impl FourBar {
    fn new(degrees: f64, alpha: f64) -> Self {
        let (crank, rod, rocker, pivot) = (40.0, 120.0, 80.0, [110.0, 0.0]);
        let a = times(unit(degrees.to_radians()), crank);
        let way = minus(pivot, a);
        let far = long(way);
        let along: f64 = (far * far + rod * rod - rocker * rocker) / (2.0 * far);
        let u = times(way, 1.0 / far);
        let b = plus(a, plus(times(u, along), times(square(u), (rod * rod - along * along).sqrt())));
        Self { a, b, pivot, alpha }
    }

    fn scene(&self) -> Scene {
        read(&json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": self.pivot },
            "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 120 },
                       "4": { "joins": ["O4", "B"], "length": 80 } },
            "near": { "B": self.b },
            "input": { "link": 2, "angle": libm::atan2(self.a[1], self.a[0]).to_degrees(),
                       "omega": "10 rad/s ccw", "alpha": format!("{} rad/s^2 ccw", self.alpha) },
            "find": ["v(B)", "omega(3)", "omega(4)", "a(B)", "alpha(3)", "alpha(4)"]
        }))
    }

    /// Lines of B in the two polygons as they should be: of the rod, of the rocker.
    fn lines(&self) -> [Xy; 2] {
        [square(minus(self.b, self.a)), square(minus(self.b, self.pivot))]
    }

    /// Both polygons with these lines of B in each, and the feet of the normal parts (rod, rocker).
    fn drawn(&self, velocity: [Xy; 2], acceleration: [Xy; 2]) -> (Drawing, [Xy; 2]) {
        let (rod, rocker) = (minus(self.b, self.a), minus(self.b, self.pivot));
        let va = turned(OMEGA, self.a);
        let vb = meet(va, velocity[0], [0.0; 2], velocity[1]);
        let normal = |v: Xy, arm: Xy| times(arm, -(long(v) / long(arm)) * (long(v) / long(arm)));
        let aa = plus(times(self.a, -OMEGA * OMEGA), turned(self.alpha, self.a));
        let feet = [plus(aa, normal(minus(vb, va), rod)), normal(vb, rocker)];
        let ab = meet(feet[0], acceleration[0], feet[1], acceleration[1]);
        let (v, a) = (0.2, 0.02);
        let velocity = vec![("o", [0.0; 2]), ("a", times(va, v)), ("b", times(vb, v))];
        let acceleration = vec![("o'", [0.0; 2]), ("a'", times(aa, a)), ("b'", times(ab, a))];
        (Drawing { velocity, acceleration }, feet.map(|foot| times(foot, a)))
    }

    /// The values that somebody reads off it.
    fn values(&self, drawing: &Drawing, feet: [Xy; 2]) -> Value {
        let [_, (_, va), (_, vb)] = drawing.velocity[..] else { unreachable!() };
        let (_, ab) = drawing.acceleration[2];
        let (rod, rocker) = (minus(self.b, self.a), minus(self.b, self.pivot));
        let vector = |mm: Xy, scale: f64, unit: &str| {
            let of = times(mm, scale);
            json!({ "magnitude": format!("{:.4} {unit}", long(of)),
                    "direction": libm::atan2(of[1], of[0]).to_degrees() })
        };
        let rate = |mm: Xy, scale: f64, arm: Xy| scale * long(mm) / long(arm) * cross(arm, mm).signum();
        json!({
            "v(B)": vector(vb, 5.0, "mm/s"), "a(B)": vector(ab, 50.0, "mm/s^2"),
            "omega(3)": format!("{:.4} rad/s", rate(minus(vb, va), 5.0, rod)),
            "omega(4)": format!("{:.4} rad/s", rate(vb, 5.0, rocker)),
            "alpha(3)": format!("{:.4} rad/s^2", rate(minus(ab, feet[0]), 50.0, rod)),
            "alpha(4)": format!("{:.4} rad/s^2", rate(minus(ab, feet[1]), 50.0, rocker)),
        })
    }
}

fn points(of: &[(&str, Xy)]) -> Map<String, Value> {
    of.iter().map(|(name, at)| ((*name).to_owned(), json!(at))).collect()
}

fn hand_in(drawing: &Drawing) -> Value {
    json!({
        "points": { "velocity": points(&drawing.velocity), "acceleration": points(&drawing.acceleration) },
        "scales": { "length": "1:1", "velocity": "5 mm/s per mm", "acceleration": "50 mm/s^2 per mm" }
    })
}

/// Which foot is the first is nobody's to say but the student's: both ways are right, and one foot alone is.
#[test]
fn feet_are_the_students_to_letter() {
    let bars = FourBar::new(60.0, 0.0);
    let scene = bars.scene();
    for names in [["b1'", "b2'"], ["b2'", "b1'"]] {
        for handed_in in [&[0, 1][..], &[0], &[1]] {
            let (mut drawing, feet) = bars.drawn(bars.lines(), bars.lines());
            drawing.acceleration.extend(handed_in.iter().map(|&foot| (names[foot], feet[foot])));
            let report = graded(&scene, &hand_in(&drawing));
            assert!(report.holds(), "{names:?} {handed_in:?}\n{}", report.to_text());
        }
    }
}

/// A normal part laid off outward is that of the rod under whichever letter, and told by the student's own.
#[test]
fn a_wrong_foot_keeps_its_letter() {
    let bars = FourBar::new(60.0, 0.0);
    let scene = bars.scene();
    for names in [["b1'", "b2'"], ["b2'", "b1'"]] {
        let (mut drawing, feet) = bars.drawn(bars.lines(), bars.lines());
        let (_, aa) = drawing.acceleration[1];
        let outward = minus(times(aa, 2.0), feet[0]);
        let [rod, rocker] = bars.lines();
        drawing.acceleration[2].1 = meet(outward, rod, feet[1], rocker);
        drawing.acceleration.extend([(names[0], outward), (names[1], feet[1])]);
        let (report, figure) = both(&scene, &hand_in(&drawing));
        assert_eq!(first_kind(&report), Some(Kind::NormalAwayFromCentre), "{}", report.to_text());
        assert_eq!(wrong(&report), [format!("acceleration:{}", names[0])], "{}", report.to_text());
        let own = format!("b′{}*", &names[0][1..2]);
        let starred = starred(&figure);
        assert!(starred.contains(&own) && starred.len() == 2, "{starred:?}");
    }
}

/// The tangential part laid off before the normal part: the foot is the other corner of their rectangle.
#[test]
fn components_are_laid_off_in_any_order() {
    let bars = FourBar::new(70.0, 60.0);
    let scene = bars.scene();
    let (mut drawing, _) = bars.drawn(bars.lines(), bars.lines());
    let [normal, tangential] =
        [times(bars.a, -0.02 * OMEGA * OMEGA), times(turned(bars.alpha, bars.a), 0.02)];
    for foot in [normal, tangential] {
        drawing.acceleration.push(("a1'", foot));
        let report = graded(&scene, &hand_in(&drawing));
        assert!(report.holds(), "{foot:?}\n{}", report.to_text());
        drawing.acceleration.pop();
    }
    // One that is neither is wrong.
    drawing.acceleration.push(("a1'", times(normal, 0.5)));
    assert_eq!(wrong(&graded(&scene, &hand_in(&drawing))), ["acceleration:a1'"]);
}

/// The texts of a figure without what lowers them.
fn texts(figure: &Figure) -> Vec<String> {
    let mut all = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.push(text.runs.iter().map(|run| run.text.as_str()).collect::<String>());
        }
    });
    all
}

/// The student's letters in a figure.
fn starred(figure: &Figure) -> Vec<String> {
    texts(figure).into_iter().filter(|text| text.ends_with('*') && !text.contains(' ')).collect()
}

/// The lines of a class.
fn lines(figure: &Figure, of: &str) -> Vec<[kurbo::Point; 2]> {
    let mut all = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Mark(mark) = node
            && let Shape::Line(from, to) = mark.shape
            && mark.class == of
        {
            all.push([from, to]);
        }
    });
    all
}

/// Whoever hands in his points has these and the vectors between them in the overlay: no ray from the pole to a foot, and
/// nothing that he has not.
#[test]
fn an_overlay_has_what_was_drawn() {
    let bars = FourBar::new(60.0, 0.0);
    let scene = bars.scene();
    let (mut drawing, feet) = bars.drawn(bars.lines(), bars.lines());
    let (_, right) = drawing.acceleration[2];
    let elsewhere = plus(right, [9.0, 14.0]);
    drawing.acceleration[2].1 = elsewhere;
    drawing.acceleration.extend([("b1'", feet[1]), ("b2'", feet[0])]);
    let (report, figure) = both(&scene, &hand_in(&drawing));
    assert!(!report.holds());
    let drawn = lines(&figure, "student");
    assert!(!drawn.is_empty());
    // All of his lines lead to the one place that is wrong, from others that he handed in, as far from each other as on paper.
    let end = drawn[0][1];
    let mut lengths: Vec<f64> = drawn
        .iter()
        .map(|[from, to]| {
            assert!(to.distance(end) < 1e-6, "{drawn:?}");
            from.distance(*to)
        })
        .collect();
    lengths.sort_by(f64::total_cmp);
    let (_, aa) = drawing.acceleration[1];
    let from = [[0.0; 2], aa, feet[0], feet[1]];
    let mut expected: Vec<f64> = from.iter().map(|from| long(minus(elsewhere, *from))).collect();
    expected.sort_by(f64::total_cmp);
    assert_eq!(lengths.len(), expected.len(), "{lengths:?} {expected:?}");
    assert!(lengths.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 0.05), "{lengths:?} {expected:?}");
    assert_eq!(starred(&figure), ["b′*"]);
    // Without feet there are none.
    drawing.acceleration.truncate(3);
    let (_, figure) = both(&scene, &hand_in(&drawing));
    assert_eq!(starred(&figure), ["b′*"]);
}

/// What is many times too large leaves what is right as large as it is to be seen.
#[test]
fn beside_what_is_too_large_the_right_polygon_is_no_speck() {
    let bars = FourBar::new(60.0, 0.0);
    let scene = bars.scene();
    let (drawing, feet) = bars.drawn(bars.lines(), bars.lines());
    let mut values = bars.values(&drawing, feet);
    // ω in rpm for rad/s.
    let times = 30.0 / std::f64::consts::PI;
    let a = long(drawing.acceleration[2].1) * 50.0 * times * times;
    values["a(B)"] = json!(format!("{a:.0} mm/s^2"));
    let answers = json!({ "values": { "a(B)": values["a(B)"] },
        "scales": { "acceleration": format!("{} mm/s^2 per mm", 50.0 * times * times) } });
    let (_, figure) = both(&scene, &answers);
    let mut longest = 0.0_f64;
    figure.root.walk(&mut |node| {
        if let Node::Mark(mark) = node
            && let (Shape::Line(from, to), Some(pen)) = (&mark.shape, mark.pen)
            && pen.dash == Dash::Solid
        {
            longest = longest.max(from.distance(*to));
        }
    });
    assert!(longest > 30.0, "{longest}");
}

/// A line of the polygon by another line of the skeleton is told as such, with both lines.
#[test]
fn a_line_by_another_link_is_named() {
    let (mut named, mut all) = (0, 0);
    let mut told = Vec::new();
    for degrees in [60.0, 75.0, 110.0, 245.0] {
        let bars = FourBar::new(degrees, 0.0);
        let scene = bars.scene();
        let (rod, rocker, crank) = (minus(bars.b, bars.a), minus(bars.b, bars.pivot), bars.a);
        let others: [(&str, [Xy; 2]); 7] = [
            ("∥ O4B instead of ⊥ AB", [rocker, square(rocker)]),
            ("⊥ O2A instead of ⊥ O4B", [square(rod), square(crank)]),
            ("∥ O2A instead of ⊥ O4B", [square(rod), crank]),
            ("∥ AB instead of ⊥ O4B", [square(rod), rod]),
            ("∥ O2A instead of ⊥ AB", [crank, square(rocker)]),
            ("∥ O2O4 instead of ⊥ O4B", [square(rod), bars.pivot]),
            ("∥ O2O4 instead of ⊥ AB", [bars.pivot, square(rocker)]),
        ];
        for (how, lines) in others {
            let flat = cross(lines[0], lines[1]).abs() / long(lines[0]) / long(lines[1]);
            let right = bars.lines();
            let (drawing, feet) = bars.drawn(lines, right);
            let steep = [0, 1].map(|i| cross(lines[i], right[i]).abs() / long(lines[i]) / long(right[i]));
            // What hardly differs, or flies off the paper, teaches nothing.
            let (_, vb) = drawing.velocity[2];
            if flat < 0.3 || steep[0].max(steep[1]) < 0.2 || long(vb) > 200.0 || long(vb) < 8.0 {
                continue;
            }
            all += 1;
            let report = graded(&scene, &json!({ "values": bars.values(&drawing, feet) }));
            let text = report.first_fault().map_or(String::new(), |fault| fault.text().to_string());
            if first_kind(&report) == Some(Kind::WrongLine) && text.contains(how) {
                named += 1;
            } else {
                told.push(format!("{degrees} {how}: {text}"));
            }
        }
    }
    println!("{named} of {all}");
    assert!(all >= 15 && named * 10 >= all * 9, "{named} of {all}\n{}", told.join("\n"));
}

/// The same wrong line in both polygons is one mistake.
#[test]
fn one_wrong_line_in_both_polygons_costs_one_mark() {
    let bars = FourBar::new(75.0, 0.0);
    let [rod, _] = bars.lines();
    let by_the_rod = [rod, minus(bars.b, bars.a)];
    let (drawing, feet) = bars.drawn(by_the_rod, by_the_rod);
    let report = graded(&bars.scene(), &json!({ "values": bars.values(&drawing, feet) }));
    assert_eq!(first_kind(&report), Some(Kind::WrongLine), "{}", report.to_text());
    assert_eq!(wrong(&report).len(), 1, "{}", report.to_text());
}

/// ε of both links from the whole acceleration is one mistake as well.
#[test]
fn one_wrong_formula_of_two_links_costs_one_mark() {
    let bars = FourBar::new(75.0, 0.0);
    let (drawing, feet) = bars.drawn(bars.lines(), bars.lines());
    let mut values = bars.values(&drawing, feet);
    let [_, (_, aa), (_, ab)] = drawing.acceleration[..] else { unreachable!() };
    let sign = |name: &str| if values[name].as_str().unwrap().starts_with('-') { "-" } else { "" };
    let whole = [("alpha(3)", long(minus(ab, aa)) * 50.0 / 120.0), ("alpha(4)", long(ab) * 50.0 / 80.0)];
    let whole = whole.map(|(name, own)| (name, format!("{}{own:.4} rad/s^2", sign(name))));
    for (name, own) in whole {
        values[name] = json!(own);
    }
    let report = graded(&bars.scene(), &json!({ "values": values }));
    assert_eq!(first_kind(&report), Some(Kind::RateFromWrongVector), "{}", report.to_text());
    assert_eq!(wrong(&report).len(), 1, "{}", report.to_text());
}

/// A slip by a little more than the room is a slip, whatever lies near it; and what answers that are right rule out is not told.
#[test]
fn what_right_answers_contradict_is_not_told() {
    let bars = FourBar::new(60.0, 0.0);
    let scene = bars.scene();
    let (drawing, feet) = bars.drawn(bars.lines(), bars.lines());
    let right = bars.values(&drawing, feet);
    let omega: f64 = right["omega(3)"].as_str().unwrap().trim_end_matches(" rad/s").parse().unwrap();
    for part in [1.12, 1.15, 0.86] {
        let mut values = right.clone();
        values["omega(3)"] = json!(format!("{:.4} rad/s", omega * part));
        let report = graded(&scene, &json!({ "values": values }));
        assert_eq!(wrong(&report), ["omega(3)"], "{}", report.to_text());
        assert!(report.first_fault().unwrap().mistakes.is_empty(), "{part}\n{}", report.to_text());
    }
}

/// Two dots at one place, a letter beside each: both are where they stand.
#[test]
fn two_dots_at_one_place_are_two_points() {
    let bars = FourBar::new(60.0, 0.0);
    // ⊥ O2A for ⊥ AB: the line from a goes through the pole.
    let (drawing, _) = bars.drawn([square(square(square(bars.a))), bars.lines()[1]], bars.lines());
    let mut inside = String::new();
    for ((name, at), (x, y)) in drawing.velocity.iter().zip([(-4.0, 5.0), (-4.0, -4.0), (5.0, 4.0)]) {
        let [u, v] = [100.0 + at[0] + 0.03 * x, 100.0 - at[1] + 0.02 * y];
        inside += &format!(
            r#"<circle cx="{u:.3}" cy="{v:.3}" r="0.6"/><text x="{:.3}" y="{:.3}" font-size="4">{name}</text>"#,
            u + x - 1.0,
            v + y + 1.3
        );
    }
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200"><g id="velocity">{inside}</g></svg>"#
    );
    let report = drawn(&bars.scene(), &svg);
    assert!(report.not_read.is_empty(), "{}", report.to_text());
    assert_eq!(wrong(&report), ["velocity:b"], "{}", report.to_text());
}

/// A polygon in its layer that is lettered with capitals is one of images.
#[test]
fn capitals_in_the_layer_of_a_polygon_are_images() {
    let bars = FourBar::new(60.0, 0.0);
    let (drawing, _) = bars.drawn(bars.lines(), bars.lines());
    let mut inside = String::new();
    for (name, at) in &drawing.velocity {
        let [u, v] = [100.0 + at[0], 100.0 - at[1]];
        let name = name.to_uppercase();
        inside += &format!(
            r#"<circle cx="{u:.3}" cy="{v:.3}" r="0.6"/><text x="{:.3}" y="{:.3}" font-size="4">{name}</text>"#,
            u + 2.0,
            v + 4.0
        );
    }
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200"><g id="velocity">{inside}</g></svg>"#
    );
    let report = drawn(&bars.scene(), &svg);
    let names: Vec<&str> = report.quantities.iter().map(|graded| graded.name.as_str()).collect();
    assert_eq!(names, ["velocity:a", "velocity:b"], "{}", report.to_text());
    assert!(report.holds(), "{}", report.to_text());
}

fn drawn(scene: &Scene, svg: &str) -> Report {
    let text = json!({ "scales": { "velocity": "5 mm/s per mm" }, "values": {}, "drawing": "own.svg" });
    let mut answers = read_answers(&text.to_string(), scene).unwrap();
    answers.add_drawing(svg, "own.svg", scene).unwrap();
    linkgram::grade::grade(scene, &answers, &GradeSettings::default()).unwrap()
}
