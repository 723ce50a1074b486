use std::f64::consts::PI;

use super::{EXAMPLE, close, example_with, good};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{
    Direction, Form, Given, GuidePoint, Input, LinkId, Path, Pin, Place, PointId, Rider, Roll, Sense,
};
use crate::scene::{AngularAcceleration, Refusal, Subject};

#[test]
fn the_example_in_si() {
    let scene = good(EXAMPLE);
    let m = &scene.mechanism;
    assert_eq!(scene.title.in_language("en"), Some("Problem 3-1: four-bar, two-arm rocker, rod and slider"));
    let numbers: Vec<u32> = m.links.iter().map(|l| l.number).collect();
    assert_eq!(numbers, [1, 2, 3, 4, 5, 6]);
    let names: Vec<&str> = m.points.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["O2", "O4", "A", "B", "C", "D"]);
    let Place::Fixed([x, y]) = m.points[1].place else { panic!() };
    assert_eq!((x.value, y.value), (0.45, 0.15));
    assert!(x.error > 0.0 && x.error <= 0.45 * f64::EPSILON * 1.01);
    assert_eq!(m.points[0].place, Place::Fixed([Given::exact(0.0); 2]));
    assert_eq!(m.points[3].place, Place::Near([0.52, -0.14]));
    assert_eq!(m.points[2].place, Place::Unknown);

    let Form::Length(length) = m.links[1].form else { panic!() };
    assert_eq!(length.value, 0.15);
    let Form::Line(positions) = &m.links[3].form else { panic!() };
    assert_eq!(positions.iter().map(|p| p.value).collect::<Vec<_>>(), [0.0, 0.3, -0.3]);
    assert_eq!((&m.links[5].form, m.links[5].block), (&Form::Single, true));
    assert_eq!(m.links[5].points, [PointId(5)]);
    assert_eq!(m.points[5].links, [LinkId(4), LinkId(5)]);

    let pairs: Vec<(usize, usize, usize)> =
        m.pins.iter().map(|Pin { point, links: [a, b] }| (point.0, a.0, b.0)).collect();
    assert_eq!(pairs, [(0, 0, 1), (1, 0, 3), (2, 1, 2), (3, 2, 3), (4, 3, 4), (5, 4, 5)]);

    let [slide] = m.slides.as_slice() else { panic!() };
    assert_eq!(slide.rider, Rider::Pin { point: PointId(5), block: Some(LinkId(5)) });
    assert_eq!(slide.guide.link, LinkId::FRAME);
    let Path::Straight { through: GuidePoint::Own([x, y]), direction, .. } = slide.guide.path else {
        panic!()
    };
    assert_eq!((x.value, y.value, direction), (0.0, 0.37, Direction::Angle(Given::exact(0.0))));

    let [Input::Angle { link, angle: Some(angle), omega, alpha }] = m.inputs.as_slice() else { panic!() };
    assert_eq!((link.0, omega.value, *alpha), (1, -10.0, Given::exact(0.0)));
    close(*angle, PI / 6.0);

    let units: Vec<(&str, &str)> =
        m.asked.iter().map(|a| (a.name.as_str(), a.unit.symbol.as_str())).collect();
    let expected = [
        ("v(B)", "cm/s"),
        ("v(B/A)", "cm/s"),
        ("omega(3)", "rad/s"),
        ("omega(4)", "rad/s"),
        ("a(D)", "cm/s^2"),
        ("alpha(3)", "rad/s^2"),
        ("rub(B)", "cm/s"),
    ];
    assert_eq!(units, expected);
    assert_eq!(m.asked[1].quantity, Quantity::RelativeVelocity(PointId(3), PointId(2)));
    assert_eq!(m.asked[6].quantity, Quantity::Rub(PointId(3), LinkId(2), LinkId(3)));
    assert_eq!(m.points[3].journal.map(|j| j.value), Some(0.005));

    let [v, omega, alpha] = scene.published.as_slice() else { panic!() };
    assert_eq!((v.value, v.signed, v.within), (1.7, false, None));
    assert_eq!((omega.value, omega.signed), (5.66, true));
    assert_eq!((alpha.value, alpha.signed, alpha.within), (16.48, false, Some(0.1)));
    assert_eq!(alpha.why.as_deref(), Some("1 mm on the printed drawing"));
    assert_eq!(omega.asked.unit.symbol, "rad/s");
}

/// Both solvers trust `Given::error`; a fraction that cannot be read exactly must carry one.
#[test]
fn numbers_with_units() {
    // (as written, scene units, SI value)
    let lengths = [
        ("15", "cm", 0.15),
        ("\"15\"", "cm", 0.15),
        ("\"6 in\"", "cm", 0.1524),
        ("\"6in\"", "m", 0.1524),
        ("\"2 ft\"", "m", 0.6096),
        ("\"1.5e2 mm\"", "m", 0.15),
        ("\"3 km\"", "nm", 3000.0),
        ("7", "nm", 7e-9),
        ("\"4 um\"", "m", 4e-6),
        ("\".5 m\"", "cm", 0.5),
        ("1e-3", "m", 1e-3),
    ];
    for (written, unit, expected) in lengths {
        let text = format!(
            r#"{{"units": {{"length": "{unit}"}}, "links": {{"2": {{"joins": ["A", "B"], "length": {written}}}}}}}"#
        );
        let Form::Length(length) = good(&text).mechanism.links[1].form else { panic!() };
        close(length, expected);
        assert!(length.error > 0.0 && length.error < expected * 1e-15, "{written}");
    }
}

fn input(omega: &str, time: &str) -> f64 {
    let text =
        example_with("\"10 rad/s cw\"", omega).replace("\"time\": \"s\"", &format!("\"time\": \"{time}\""));
    let Input::Angle { omega, .. } = good(&text).mechanism.inputs[0] else { panic!() };
    omega.value
}

#[test]
fn angular_velocities() {
    let table = [
        ("\"75 rpm cw\"", "s", -2.5 * PI),
        ("\"75 rpm\"", "s", 2.5 * PI),
        ("\"-75 rpm cw\"", "s", 2.5 * PI),
        ("10", "s", 10.0),
        ("600", "min", 10.0),
        ("\"600 rad/min ccw\"", "s", 10.0),
        ("\"90 deg/s\"", "min", PI / 2.0),
        ("\"2 rev/min\"", "s", PI / 15.0),
        ("\"-3\"", "s", -3.0),
        ("\"3 cw\"", "s", -3.0),
        ("3", "ms", 3000.0),
    ];
    for (written, time, expected) in table {
        let value = input(written, time);
        assert!((value - expected).abs() <= 1e-15 * expected.abs().max(1.0) * 4.0, "{written}: {value}");
    }
}

fn angle(written: &str, unit: &str) -> Given {
    let text = example_with("\"angle\": 30", &format!("\"angle\": {written}"))
        .replace("\"angle\": \"deg\"", &format!("\"angle\": \"{unit}\""));
    let Input::Angle { angle: Some(angle), .. } = good(&text).mechanism.inputs[0] else { panic!() };
    angle
}

/// Whole turns leave no trace in the value, quarter turns are the double nearest to theirs.
#[test]
fn angles_of_any_number_of_turns() {
    assert_eq!(angle("3630", "deg").value, angle("30", "deg").value);
    assert_eq!(angle("\"-330 deg\"", "deg").value, angle("30", "deg").value);
    assert_eq!(angle("360000000030", "deg").value, angle("30", "deg").value);
    assert_eq!(angle("90", "deg").value, PI / 2.0);
    assert_eq!(angle("-90", "deg").value, -PI / 2.0);
    assert_eq!(angle("450", "deg").value, PI / 2.0);
    assert_eq!(angle("180", "deg").value, PI);
    assert_eq!(angle("-180", "deg").value, PI);
    assert_eq!(angle("360", "deg").value, 0.0);
    assert_eq!(angle("1000000.25", "rev").value, PI / 2.0);
    assert_eq!(angle("\"30 cw\"", "deg").value, -angle("30", "deg").value);
    assert_eq!(angle("1.5", "rad").value, 1.5);
    close(angle("3e9", "rev"), 0.0);
    // The written number's own last place counts before the turns are taken off.
    assert!(angle("360000000030", "deg").error > 1e5 * angle("30", "deg").error);
}

#[test]
fn without_find_everything_that_moves() {
    let text = example_with(
        r#""find":   ["v(B)", "v(B/A)", "omega(3)", "omega(4)", "a(D)", "alpha(3)", "rub(B)"],"#,
        "",
    );
    let scene = good(&text);
    let names: Vec<&str> = scene.mechanism.asked.iter().map(|a| a.name.as_str()).collect();
    let expected = "v(A) v(B) v(C) v(D) a(A) a(B) a(C) a(D) omega(2) omega(3) omega(4) omega(5) omega(6) \
                    alpha(2) alpha(3) alpha(4) alpha(5) alpha(6)";
    assert_eq!(names, expected.split_whitespace().collect::<Vec<_>>());
}

/// Crank and slotted lever with everything that a guide may say.
const SLOTTED: &str = r#"{
  "units": { "length": "mm", "time": "min" },
  "fixed": { "O2": [0, 0], "O4": [0, -300], "P": [5, 5] },
  "links": {
    "2": { "joins": ["O2", "A"], "length": 100 },
    "4": { "joins": ["O4", "B", "G"], "shape": { "O4": [0, 0], "B": [0, 600], "G": [10, 20] } },
    "6": { "joins": ["Q", "R"], "length": 50 },
    "7": { "joins": ["O4"] }
  },
  "slides": [
    { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B", "turned": 5, "offset": 2 } },
    { "pin": "B", "on": { "link": 1, "centre": "P", "radius": "40 cm" } },
    { "link": 6, "turned": 90, "on": { "link": 4, "through": [1, 2], "angle": "0.5 rad" } },
    { "pin": "R", "on": { "link": 7, "through": "O4" } }
  ],
  "inputs": [
    { "link": 2, "angle": 400, "speed": { "A": "6 m/s cw" }, "alpha": 3600 },
    { "slide": 6, "at": 12, "velocity": "3 m/s", "acceleration": "1 m/s^2" },
    { "slide": "B", "at": 1 }
  ],
  "find": [
    "slip(A/4)", "aslip(A/4)", "coriolis(A/4)", "aslipn(B/1)", "aslipt( B / 1 )", "I(1,3)", "x(B)", "angle(3)",
    "transmission(3/2)", "an(A/O2)", "at(A)", "omega(3/2)", "alpha(4/1)", "slip(R/4)", "rub(O4, 4/7)",
    { "name": "omega(4)", "unit": "rpm", "method": "polygon" }, "a(B/A)", "v(R)"
  ],
  "pins": { "O4": { "diameter": "1 cm" } }
}"#;

#[test]
fn guides_of_every_kind() {
    let text = SLOTTED
        .replace("    { \"slide\": \"B\", \"at\": 1 }\n", "")
        .replace("\"acceleration\": \"1 m/s^2\" },\n", "\"acceleration\": \"1 m/s^2\" }\n");
    let scene = good(&text);
    let m = &scene.mechanism;
    let point = |name: &str| m.point_named(name).unwrap();
    let link = |number| m.link_numbered(number).unwrap();
    let Path::Straight { through, direction, turned, offset } = m.slides[0].guide.path else { panic!() };
    assert_eq!(through, GuidePoint::Point(point("O4")));
    assert_eq!(direction, Direction::Toward(point("B")));
    close(turned, PI / 36.0);
    close(offset, 0.002);
    let Path::Arc { centre, radius } = m.slides[1].guide.path else { panic!() };
    assert_eq!((centre, radius.value), (GuidePoint::Point(point("P")), 0.4));
    assert_eq!(m.slides[1].rider, Rider::Pin { point: point("B"), block: None });
    let Rider::Link { link: rider, turned: Some(turned) } = m.slides[2].rider else { panic!() };
    assert_eq!((rider, turned.value), (link(6), PI / 2.0));
    assert_eq!(m.link(link(7)).form, Form::Single);
    assert!(!m.link(link(7)).block && m.link(link(3)).block);
    assert_eq!(m.point(point("O4")).links, [LinkId::FRAME, link(4), link(7)]);
    let at_o4: Vec<[LinkId; 2]> = m.pins.iter().filter(|p| p.point == point("O4")).map(|p| p.links).collect();
    assert_eq!(at_o4, [[LinkId::FRAME, link(4)], [LinkId::FRAME, link(7)]]);
    let Input::Speed { angle: Some(angle), point: driven, speed, alpha, .. } = m.inputs[0] else { panic!() };
    close(angle, PI / 4.5);
    assert_eq!((driven, speed.value), (point("A"), -6.0));
    close(alpha, 1.0);
    let Input::Slide { slide: 2, at: Some(at), velocity, acceleration } = m.inputs[1] else { panic!() };
    assert_eq!((at.value, velocity.value, acceleration.value), (0.012, 3.0, 1.0));
    let quantities: Vec<Quantity> = m.asked.iter().map(|a| a.quantity).collect();
    let (a, b, four) = (point("A"), point("B"), link(4));
    assert_eq!(
        quantities,
        [
            Quantity::Slip(a, four),
            Quantity::SlipAcceleration(a, four),
            Quantity::Coriolis(a, four),
            Quantity::SlipNormal(b, LinkId::FRAME),
            Quantity::SlipTangential(b, LinkId::FRAME),
            Quantity::Centre(LinkId::FRAME, link(3)),
            Quantity::Position(b),
            Quantity::Angle(link(3)),
            Quantity::Transmission(link(3), link(2)),
            Quantity::RelativeNormal(a, point("O2")),
            Quantity::Tangential(a),
            Quantity::RelativeOmega(link(3), link(2)),
            Quantity::RelativeAlpha(four, LinkId::FRAME),
            Quantity::Slip(point("R"), four),
            Quantity::Rub(point("O4"), four, link(7)),
            Quantity::Omega(four),
            Quantity::RelativeAcceleration(b, a),
            Quantity::Velocity(point("R")),
        ]
    );
    let symbols: Vec<&str> = m.asked.iter().map(|a| a.unit.symbol.as_str()).collect();
    assert_eq!(symbols[0], "mm/min");
    assert_eq!(symbols[1], "mm/min^2");
    assert_eq!(symbols[5], "mm");
    assert_eq!(symbols[7], "deg");
    assert_eq!(symbols[11], "rad/min");
    assert_eq!(symbols[15], "rpm");
    assert!((m.asked[15].unit.si - PI / 30.0).abs() < 1e-16);
    assert!((m.asked[1].unit.si - 1e-3 / 3600.0).abs() < 1e-21);
    assert_eq!(m.asked[4].name, "aslipt( B / 1 )");
    // The third input of the table above drives a pin on an arc.
    assert!(super::bad(SLOTTED).what.contains("arc"));
}

#[test]
fn forms_of_links() {
    let scene = good(
        r#"{
        "units": { "length": "m" }, "fixed": { "O": [0, 0] }, "placed": { "P": [3, 4] },
        "links": {
            "2": { "joins": ["O", "A", "B"], "sides": [3, 4, 5], "turn": "cw" },
            "3": { "joins": ["A", "C", "D"], "arms": [2, 1, "90 deg cw"] },
            "4": { "joins": ["O", "P"] },
            "5": { "joins": ["D", "E"], "sides": [1, 1, 1] }
        } }"#
            .replace(", \"E\"], \"sides\": [1, 1, 1]", ", \"E\", \"F\"], \"sides\": [1, 1, 1]")
            .as_str(),
    );
    let links = &scene.mechanism.links;
    let Form::Sides { first_second, second_third, third_first, turn: Sense::Cw } = links[1].form else {
        panic!()
    };
    assert_eq!([first_second.value, second_third.value, third_first.value], [3.0, 4.0, 5.0]);
    let Form::Arms { second, third, angle } = links[2].form else { panic!() };
    assert_eq!((second.value, third.value, angle.value), (2.0, 1.0, -PI / 2.0));
    assert_eq!(links[3].form, Form::Placed);
    assert!(matches!(links[4].form, Form::Sides { turn: Sense::Ccw, .. }));
}

#[test]
fn rolling_pairs() {
    let text = r#"{
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2"] }, "3": { "joins": ["A"] }, "5": { "joins": ["A", "O2"], "length": 175 },
                   "6": { "joins": ["C"] } },
        "rolls": [
            { "links": [2, 3], "centres": ["O2", "A"], "radii": [75, 100] },
            { "links": [1, 3], "centres": ["O2", "A"], "teeth": [110, 40], "module": "5 mm", "internal": true },
            { "links": [1, 6], "line": { "link": 1, "through": [0, -20] }, "centre": "C", "radius": 30 },
            { "links": [6, 1], "line": { "through": "O2", "angle": 90 }, "centre": "C", "teeth": 20, "module": 3 }
        ] }"#;
    let m = good(text).mechanism;
    let Roll::Circles { radii, internal: false, .. } = m.rolls[0] else { panic!() };
    assert_eq!(radii.map(|r| r.value), [0.075, 0.1]);
    let Roll::Circles { radii, internal: true, links, .. } = m.rolls[1] else { panic!() };
    close(radii[0], 0.275);
    close(radii[1], 0.1);
    assert_eq!(links, [LinkId(0), LinkId(2)]);
    for roll in &m.rolls[2..] {
        let Roll::Line { guide, wheel, radius, .. } = roll else { panic!() };
        assert_eq!((guide.link, *wheel, radius.value), (LinkId(0), LinkId(4), 0.03));
    }
}

#[test]
fn titles_sheets_errata() {
    let text = example_with(
        "\"Problem 3-1: four-bar, two-arm rocker, rod and slider\"",
        r#"{ "en": "slider", "ar": "منزلق" }"#,
    );
    let text = text.replace(
        "\"near\":",
        r#""errata": ["v(B)"], "expect": "ambiguous", "$schema": "x",
        "sheet": { "paper": "a3 landscape", "language": "ar-x-ajala", "symbols": "epsilon", "figures": ["skeleton"],
                   "scales": { "length": "1:10", "velocity": "50 cm/s per cm", "acceleration": "500 per 2 cm" } },
        "near":"#,
    );
    let scene = good(&text);
    assert_eq!(scene.title.in_language("ar-x-ajala"), Some("منزلق"));
    assert_eq!(scene.title.in_language("fa"), Some("slider"));
    assert_eq!(scene.errata, ["v(B)"]);
    assert_eq!(scene.expect, Some(Refusal::Ambiguous));
    assert_eq!(scene.sheet.paper.as_deref(), Some("A3 landscape"));
    assert_eq!(scene.sheet.angular_acceleration, Some(AngularAcceleration::Epsilon));
    assert_eq!(scene.sheet.length_scale, Some(10.0));
    let velocity = scene.sheet.velocity_scale.unwrap();
    assert!((velocity - 0.05).abs() < 1e-15);
    // 500 cm/s² on 2 cm of paper are 0.25 m/s² on each millimetre.
    let acceleration = scene.sheet.acceleration_scale.unwrap();
    assert!((acceleration - 0.25).abs() < 1e-15);
    assert_eq!(scene.sheet.figures, ["skeleton"]);
}

#[test]
fn later_complaints_know_the_place() {
    let scene = good(EXAMPLE);
    let source = &scene.source;
    let error = source.complain(Subject::Dimension(LinkId(2)), "the chain does not close", None);
    assert_eq!(error.to_string(), "scene.json:7:43: links.3.length: the chain does not close");
    let of = |subject| source.complain(subject, "", None).path;
    assert_eq!(of(Subject::Link(LinkId(5))), "slides[0]");
    assert_eq!(of(Subject::Inputs), "input");
    assert_eq!(of(Subject::Asked(1)), "find[1]");
    assert_eq!(of(Subject::Published(2)), "published.alpha(5)");
    assert_eq!(of(Subject::Place(PointId(3))), "near.B");
    assert_eq!(of(Subject::Point(PointId(1))), "fixed.O4");
    assert_eq!(of(Subject::Scene), "");
    assert_eq!(of(Subject::Asked(99)), "");
}

#[test]
fn an_input_angle_keeps_its_whole_turns_and_half_a_turn_its_sign() {
    let all = [
        ("30", 30.0),
        ("210", 210.0),
        ("180", 180.0),
        ("-90", -90.0),
        ("\"400 deg\"", 400.0),
        ("1500", 1500.0),
        ("-1130", -1130.0),
    ];
    for (stated, degrees) in all {
        let scene = good(&example_with("\"angle\": 30", &format!("\"angle\": {stated}")));
        let angle = scene.input_units[0].angle.unwrap().to_degrees();
        assert!((angle - degrees).abs() < 1e-9, "{stated}: {angle}");
    }
}
