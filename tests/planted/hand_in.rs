//! What a student hands in: values, lengths on the drawing, or points of the polygons.

use serde_json::{Map, Value, json};

use super::mechanism::Mechanism;
use super::mistakes::{Kind, Mistake};
use super::plane::{Chance, O, Xy, xy};
use super::student::{Diagram, Scales, Stuck, Student, solve};

/// How it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// Every vector with magnitude and direction.
    Values,
    /// The same as a table.
    Csv,
    /// Magnitudes of what an examiner asks; no normal part, no Coriolis.
    Exam,
    /// Lengths in mm of all vectors, ω and α as values.
    Lengths,
    /// Image points in mm, the skeleton's points, ω and α, magnitudes of what was computed.
    Points,
    /// The same as pixels of a scan that lies a little askew.
    Scan,
}

pub(crate) const STYLES: [Style; 6] =
    [Style::Values, Style::Csv, Style::Exam, Style::Lengths, Style::Points, Style::Scan];

/// One answer as its reader understands it.
#[derive(Debug, Clone)]
enum Answer {
    Vector(Xy),
    Magnitude(f64),
    Signed(f64),
}

/// An answer sheet.
#[derive(Debug)]
pub(crate) struct HandIn {
    pub(crate) text: String,
    pub(crate) extension: &'static str,
    answers: Vec<(String, Answer)>,
}

fn digits(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap()
}

fn tenth(p: Xy) -> Value {
    json!([(p.x * 100.0).round() / 100.0, (p.y * 100.0).round() / 100.0])
}

/// 1, 2, 2.5 or 5 times a power of ten, the least that brings `size` down to `paper` mm; per mm, round per cm.
fn round_scale(size: f64, paper: f64) -> f64 {
    let least = size / paper;
    let power = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(|m| m * power).find(|s| *s >= least).unwrap()
}

/// Scales at which this student's figures fill the paper.
fn scales_for(student: &Student<'_>, mechanism: &Mechanism) -> Scales {
    let spread = |points: &[Xy]| {
        points.iter().flat_map(|p| points.iter().map(move |q| (*p - *q).size())).fold(0.0, f64::max)
    };
    let image = |points: &[(String, Xy)]| {
        let all: Vec<Xy> = points.iter().map(|(_, p)| *p).chain([O]).collect();
        round_scale(spread(&all), 140.0)
    };
    let places: Vec<Xy> =
        student.places.iter().map(|(_, p)| *p).chain(mechanism.fixed.iter().map(|(_, p)| *p)).collect();
    Scales {
        length: round_scale(spread(&places) * mechanism.unit.mm(), 180.0) / mechanism.unit.mm(),
        velocity: image(&student.velocity),
        acceleration: image(&student.acceleration),
    }
}

/// The student at scales of his own choice, his pencil not slipping.
pub(crate) fn steady<'a>(mechanism: &'a Mechanism, planted: &'a [Mistake]) -> Result<Student<'a>, Stuck> {
    let mut scales = Scales { length: 1.0, velocity: 1.0, acceleration: 1.0 };
    for _ in 0..4 {
        let student = solve(mechanism, planted, None, scales)?;
        let next = scales_for(&student, mechanism);
        if next == scales {
            return Ok(student);
        }
        scales = next;
    }
    // A misread scale may chase its own diagram's scale for ever.
    solve(mechanism, planted, None, scales)
}

impl HandIn {
    /// Writes down what the student has found.
    pub(crate) fn of(
        student: &Student<'_>,
        mechanism: &Mechanism,
        style: Style,
        planted: &[Mistake],
        askew: &mut Chance,
    ) -> Self {
        // Whoever draws v(A@4) along the slot cannot tell which way the guide turns, nor go on to accelerations.
        let velocities_only =
            planted.iter().any(|m| m.kind == Kind::PerpendicularForParallel && m.at.starts_with("slip"));
        let unit = mechanism.unit.symbol();
        let mut answers = Vec::new();
        let mut values = Map::new();
        let mut lengths = Map::new();
        let mut rows = Vec::new();
        for reading in &student.readings {
            if velocities_only && reading.diagram == Diagram::Acceleration {
                continue;
            }
            let (per_mm, time) = match reading.diagram {
                Diagram::Velocity => (student.scales.velocity, "s"),
                Diagram::Acceleration => (student.scales.acceleration, "s^2"),
            };
            let name = reading.name.clone();
            let reckoned = ["an(", "coriolis("].iter().any(|start| name.starts_with(start));
            let asked =
                !reckoned && !name.starts_with("at(") && !name.contains("slip(") && !name.contains('@');
            let size = reading.value.size();
            let written = digits(size);
            let degrees = (reading.value.degrees() * 10.0).round() / 10.0;
            let spoilt = |how| planted.iter().any(|m| m.kind == Kind::CalculatorInRadians && m.how == how);
            // Radians written as degrees, or degrees typed into a calculator that takes them for radians.
            let radians = reading.value.degrees().to_radians();
            let (degrees, seen) = if spoilt("written") {
                let written = (radians * 1000.0).round() / 1000.0;
                (written, Xy::polar(size, written.to_radians()))
            } else {
                (degrees, reading.value)
            };
            match style {
                Style::Values if spoilt("typed") => {
                    let typed = Xy::polar(size, reading.value.degrees());
                    let component = |x: f64| json!(format!("{} {unit}/{time}", digits(x)));
                    values.insert(
                        name.clone(),
                        json!({ "components": [component(typed.x), component(typed.y)] }),
                    );
                    answers.push((name, Answer::Vector(typed)));
                }
                Style::Values => {
                    let value = json!({ "magnitude": format!("{written} {unit}/{time}"), "direction": format!("{degrees} deg") });
                    values.insert(name.clone(), value);
                    answers.push((name, Answer::Vector(seen)));
                }
                Style::Csv => {
                    rows.push(format!("{name},{written},{unit}/{time},,{degrees}"));
                    answers.push((name, Answer::Vector(seen)));
                }
                Style::Exam if asked => {
                    values.insert(name.clone(), json!(format!("{written} {unit}/{time}")));
                    answers.push((name, Answer::Magnitude(size)));
                }
                Style::Lengths => {
                    lengths
                        .insert(name.clone(), json!((reading.drawn.size() / per_mm * 10.0).round() / 10.0));
                    answers.push((name, Answer::Magnitude(reading.drawn.size())));
                }
                Style::Points | Style::Scan if reckoned => {
                    values.insert(name.clone(), json!(format!("{written} {unit}/{time}")));
                    answers.push((name, Answer::Magnitude(size)));
                }
                _ => {}
            }
        }
        for turning in &student.turnings {
            let alpha = turning.name.starts_with("alpha");
            if velocities_only && alpha {
                continue;
            }
            let written = digits(turning.value.abs());
            let symbol = if alpha { "rad/s^2" } else { "rad/s" };
            let sense = match (turning.sense, turning.value < 0.0) {
                (false, _) => "",
                (true, true) => " cw",
                (true, false) => " ccw",
            };
            if style == Style::Csv {
                rows.push(format!("{},{written},{symbol},{},", turning.name, sense.trim()));
            }
            values.insert(turning.name.clone(), json!(format!("{written} {symbol}{sense}")));
            let answer = if turning.sense {
                Answer::Signed(turning.value)
            } else {
                Answer::Magnitude(turning.value.abs())
            };
            answers.push((turning.name.clone(), answer));
        }
        if style == Style::Csv {
            let text = format!("quantity,value,unit,sense,direction\n{}\n", rows.join("\n"));
            return Self { text, extension: "csv", answers };
        }
        let per_cm = |per_mm: f64| digits(per_mm * 10.0);
        let mut sheet = json!({ "student": "N. N.", "values": values, "scales": {
            "length": format!("1:{}", digits(student.scales.length * mechanism.unit.mm())),
            "velocity": format!("{} {unit}/s per cm", per_cm(student.scales.velocity)),
            "acceleration": format!("{} {unit}/s^2 per cm", per_cm(student.scales.acceleration)) } });
        if style == Style::Lengths {
            sheet["lengths"] = json!(lengths);
        }
        if matches!(style, Style::Points | Style::Scan) {
            let mut figures = Map::new();
            let mut scans = Map::new();
            let with_pole = |points: &[(String, Xy)], per_mm: f64| {
                let pole = ("o".to_owned(), O);
                points
                    .iter()
                    .chain([&pole])
                    .map(|(n, p)| (n.clone(), *p * (1.0 / per_mm)))
                    .collect::<Vec<_>>()
            };
            let skeleton = student
                .places
                .iter()
                .cloned()
                .chain(mechanism.fixed.iter().map(|(n, p)| ((*n).to_owned(), *p)))
                .map(|(n, p)| (n, p * (1.0 / student.scales.length)))
                .collect();
            let mut figure = |name: &str, points: Vec<(String, Xy)>| {
                let corner = xy(askew.between(20.0, 120.0), askew.between(20.0, 120.0));
                let tilt = askew.between(-4.0, 4.0).to_radians();
                // Pixels of a 200 dpi scan, y down.
                let pixel =
                    |p: Xy| ((p + corner).turned(tilt) * (200.0 / 25.4)).mirrored() + xy(150.0, 2200.0);
                let on_paper = |p: Xy| if style == Style::Scan { pixel(p) } else { p + corner };
                let points: Map<_, _> = points.into_iter().map(|(n, p)| (n, tenth(on_paper(p)))).collect();
                figures.insert(name.into(), json!(points));
                let marks = [xy(0.0, 0.0), xy(100.0, 0.0)];
                scans.insert(
                    name.into(),
                    json!({ "pixels": marks.map(|m| tenth(pixel(m))), "mm": marks.map(tenth) }),
                );
            };
            figure("skeleton", skeleton);
            figure("velocity", with_pole(&student.velocity, student.scales.velocity));
            let image = |points: &[(String, Xy)], kind: &str| {
                points.iter().map(|(n, p)| (format!("{kind}:{n}"), Answer::Vector(*p))).collect::<Vec<_>>()
            };
            answers.extend(image(&student.velocity, "velocity"));
            if !velocities_only {
                figure("acceleration", with_pole(&student.acceleration, student.scales.acceleration));
                answers.extend(image(&student.acceleration, "acceleration"));
            }
            answers.extend(image(&student.places, "skeleton"));
            sheet["points"] = json!(figures);
            if style == Style::Scan {
                sheet["scan"] = json!(scans);
            }
        }
        Self { text: serde_json::to_string_pretty(&sheet).unwrap(), extension: "json", answers }
    }

    /// By how much each answer differs from that of another sheet, in its own unit; no number where the other sheet
    /// says nothing comparable.
    pub(crate) fn differences(&self, other: &Self) -> Vec<f64> {
        let difference = |(name, mine): &(String, Answer)| {
            let theirs = other.answers.iter().find(|(n, _)| n == name).map(|(_, a)| a);
            match (mine, theirs) {
                (Answer::Vector(a), Some(Answer::Vector(b))) => (*a - *b).size(),
                (Answer::Magnitude(a), Some(Answer::Magnitude(b)))
                | (Answer::Signed(a), Some(Answer::Signed(b))) => (a - b).abs(),
                (Answer::Magnitude(a), Some(Answer::Signed(b)))
                | (Answer::Signed(a), Some(Answer::Magnitude(b))) => (a.abs() - b.abs()).abs(),
                _ => f64::INFINITY,
            }
        };
        self.answers.iter().map(difference).collect()
    }

    /// Names of the answers that lie within their scatter of those of another sheet.
    pub(crate) fn names_within(&self, other: &Self, scatter: &[f64]) -> Vec<String> {
        let differences = self.differences(other);
        let near = differences.iter().zip(scatter).map(|(d, s)| d <= s);
        self.answers.iter().zip(near).filter(|(_, near)| *near).map(|((name, _), _)| name.clone()).collect()
    }

    /// Number of answers.
    pub(crate) fn count(&self) -> usize {
        self.answers.len()
    }
}
