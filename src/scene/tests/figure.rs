//! `where` and `within`: what is read, what is refused.

use super::{bad, good, place};
use crate::mechanism::statement::{Locus, Standing};
use crate::mechanism::{Form, Place};
use crate::scene::{Scene, schema};

/// A four-bar of 3-4-5 triangles, O2 (0,0), A (3,4), B (9,4), O4 (9,0), with B stated.
fn four_bar(b: &str) -> String {
    format!(
        r#"{{ "fixed": {{ "O2": [0, 0], "O4": [9, 0] }}, "placed": {{ "A": [3, 4] }}, "where": {{ "B": {b} }},
        "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "B"] }},
                    "4": {{ "joins": ["O4", "B"] }} }},
        "input": {{ "link": 2, "omega": 1 }} }}"#
    )
}

fn standing(scene: &Scene, name: &str) -> Standing {
    let point = scene.mechanism.point_named(name).unwrap();
    scene.mechanism.statement_of(point).unwrap().standing
}

#[test]
fn a_stated_point_gives_its_links_their_dimensions() {
    for b in [
        r#"[{ "from": "O4", "distance": 4 }, { "from": "A", "distance": 6 }]"#,
        r#"[{ "from": "O4", "distance": 4, "direction": 90 }]"#,
        r#"{ "from": "O4", "distance": "4 m", "direction": "0.25 rev" }"#,
        r#"[{ "from": "A", "square_to": ["O4", "A"] }, { "sees": ["A", "O4"], "at": "90 cw" }]"#,
        r#"[{ "on": { "link": 1, "through": "O4", "angle": 90 } }, { "on": { "link": 1, "centre": [9, 0], "radius": 4 } }]"#,
        r#"[{ "on": { "link": 2, "through": "A", "toward": "O2" } }, { "from": "O4", "direction": 90 }]"#,
    ] {
        let scene = good(&four_bar(b));
        assert!(matches!(place(&scene, "B"), Place::Stated(0)), "{b}");
        assert!(scene.mechanism.links.iter().all(|link| link.form == Form::Placed), "{b}");
        assert_eq!(standing(&scene, "B"), Standing::Stated, "{b}");
        assert!(scene.mechanism.is_given(scene.mechanism.point_named("B").unwrap()));
    }
}

/// What is stated of one point depends on another: the file may have them in any order.
#[test]
fn statements_are_put_in_order() {
    let text = four_bar(
        r#"[{ "from": "A", "distance": 6 }, { "from": "A", "square_to": ["A", "O4"] }],
           "A": { "from": "O2", "distance": 5, "direction": 53 }"#,
    )
    .replace(r#""placed": { "A": [3, 4] }, "#, "");
    let scene = good(&text);
    let names: Vec<&str> = scene
        .mechanism
        .statements
        .iter()
        .map(|statement| scene.mechanism.point(statement.point).name.as_str())
        .collect();
    assert_eq!(names, ["A", "B"]);
}

#[test]
fn bad_statements_name_their_points() {
    let told = |b: &str, parts: &[&str]| {
        let error = bad(&four_bar(b));
        let text = error.to_string();
        assert!(error.path.starts_with("where.B"), "{text}");
        for part in parts {
            assert!(text.contains(part), "{part}: {text}");
        }
    };
    let circle = r#"{ "from": "O4", "distance": 4 }"#;
    let ray = r#"{ "from": "O4", "direction": 90 }"#;
    told(&format!("[{circle}]"), &["B needs two loci to stand, and one is given", "sees"]);
    told("[]", &["B needs two loci to stand, and none is given"]);
    told(
        &format!("[{circle}, {ray}, {{ \"from\": \"A\", \"distance\": 6 }}]"),
        &["this one is too many", "of B"],
    );
    told(
        r#"[{ "from": "O4", "distance": 4, "direction": 90 }, { "from": "A", "distance": 6 }]"#,
        &["this one is too many"],
    );
    told(&format!("[{circle}, {circle}]"), &["the same is stated twice of B"]);
    told(r#"[{ "from": "B", "distance": 4 }]"#, &["B cannot be stated from itself", "sees"]);
    told(r#"[{ "from": "E", "distance": 4 }]"#, &["there is no point `E`"]);
    told(r#"[{ "from": "A" }]"#, &["`from` alone is no locus"]);
    told(r#"[{ "sees": ["A", "O4"] }]"#, &["`at` is missing"]);
    told(r#"[{ "sees": ["A", "A"], "at": 90 }]"#, &["the two points are one"]);
    told(r#"[{ "sees": ["A", "O4"], "at": 180 }]"#, &["its own line"]);
    told(r#"[{ "from": "A", "dist": 4 }]"#, &["unknown key `dist`", "did you mean `distance`"]);
    told(r#"[{ "from": "A", "distance": 0 }]"#, &["greater than zero"]);
    told(r#"[{ "from": "A", "distance": 4, "sees": ["A", "O4"] }]"#, &["`sees` has no meaning here"]);
    told(r#""here""#, &["expected a list of two loci"]);
    told(r#"[{ "distance": 4 }]"#, &["this is no locus"]);
    // Own coordinates of a link with dimensions of its own do not stand before it does.
    let text =
        four_bar(&format!(r#"[{circle}, {{ "on": {{ "link": 2, "through": [0, 0], "angle": 3 }} }}]"#))
            .replace(r#"["O2", "A"]"#, r#"["O2", "A"], "length": 5"#);
    let error = bad(&text);
    assert!(error.to_string().contains("own coordinates and angles of link 2 do not stand yet"), "{error}");
}

#[test]
fn circles_of_statements_and_gaps_are_named() {
    let text = four_bar(
        r#"[{ "from": "C", "distance": 1 }, { "from": "O4", "distance": 4 }],
           "C": [{ "from": "B", "distance": 1 }, { "from": "O4", "distance": 4 }]"#,
    )
    .replace(r#"["O4", "B"]"#, r#"["O4", "B", "C"]"#);
    let error = bad(&text).to_string();
    assert!(error.contains("stated in a circle: B from C, C from B"), "{error}");
    assert!(error.contains("where.B"), "{error}");
    let gap = text
        .replace(r#""C": [{ "from": "B", "distance": 1 }, { "from": "O4", "distance": 4 }]"#, r#""A": []"#);
    assert!(bad(&gap).to_string().contains("given twice"), "a point in `placed` and `where`");
    let gap = four_bar(r#"[{ "from": "C", "distance": 1 }, { "from": "O4", "distance": 4 }]"#)
        .replace(r#"["O4", "B"] }"#, r#"["O4", "B"] }, "5": { "joins": ["B", "C"], "length": 3 }"#);
    let error = bad(&gap).to_string();
    assert!(error.contains("B is stated from C, which does not stand"), "{error}");
    let fixed = four_bar(r#"{ "from": "A", "distance": 1, "direction": 2 }, "O4": []"#);
    assert!(bad(&fixed).to_string().contains("`O4` is a fixed point; `where` is for moving ones"));
}

/// Dimensions and guides beside a statement: they hold, and the place is brought onto them.
#[test]
fn dimensions_beside_a_statement() {
    let loci = r#"[{ "from": "O4", "distance": 4 }, { "from": "A", "distance": 6 }]"#;
    let four = four_bar(loci).replace(r#"["O4", "B"]"#, r#"["O4", "B"], "length": 4"#);
    // The same length is stated twice: nothing to settle.
    assert_eq!(standing(&good(&four), "B"), Standing::Stated);
    let four = four.replace(r#""length": 4 "#, r#""length": 4.0000001 "#);
    let Standing::Onto(Locus::Circle { radius, .. }) = standing(&good(&four), "B") else { panic!() };
    assert_eq!(radius.value, 4.0000001);
    let both = four.replace(r#"["A", "B"]"#, r#"["A", "B"], "length": 6"#);
    assert_eq!(standing(&good(&both), "B"), Standing::Hint);
    assert!(!good(&both).mechanism.is_given(good(&both).mechanism.point_named("B").unwrap()));
    // A guide of the frame.
    let ridden = four_bar(loci).replace(
        r#""input""#,
        r#""slides": [ { "pin": "B", "block": 5, "on": { "link": 1, "through": [0, 4] } } ], "input""#,
    );
    assert!(matches!(standing(&good(&ridden), "B"), Standing::Onto(Locus::On(_))));
}

/// A crank's end stands by its length and angle, so that others can be stated from it.
#[test]
fn a_driven_crank_stands_before_its_neighbours() {
    let text = four_bar(r#"[{ "from": "A", "distance": 6 }, { "from": "O4", "distance": 4 }]"#)
        .replace(r#""placed": { "A": [3, 4] }, "#, "")
        .replace(r#"["O2", "A"]"#, r#"["O2", "A"], "length": 5"#)
        .replace(r#""omega": 1"#, r#""angle": 53, "omega": 1"#)
        .replace(r#"["A", "B"]"#, r#"["A", "B"], "length": 6"#);
    let scene = good(&text);
    let standings: Vec<Standing> = scene.mechanism.statements.iter().map(|s| s.standing).collect();
    assert!(matches!(standings.as_slice(), [Standing::Driven, _]), "{standings:?}");
}

#[test]
fn a_place_with_room_is_taken() {
    let text = |b: &str, length: &str| {
        four_bar("[]")
            .replace(r#""where": { "B": [] },"#, "")
            .replace(r#""A": [3, 4]"#, &format!(r#""A": [3, 4], "B": {b}"#))
            .replace(r#"["O4", "B"]"#, &format!(r#"["O4", "B"]{length}"#))
    };
    let read = text(r#"{ "at": [9.02, 4.01], "within": "50 mm" }"#, "");
    let Place::Placed(b) = place(&good(&read), "B") else { panic!() };
    assert!(b.iter().all(|c| c.error >= 0.05 && c.error < 0.0501), "{b:?}");
    // A dimension that is missed by less than the room holds.
    let read = text(r#"{ "at": [9.02, 4.01], "within": "50 mm" }"#, r#", "length": 4"#);
    let Place::Placed(b) = place(&good(&read), "B") else { panic!() };
    assert!((libm::hypot(b[0].value - 9.0, b[1].value) - 4.0).abs() < 1e-14);
    assert!(b.iter().all(|c| c.error >= 0.05), "the room stays in the bound: {b:?}");
    // By more than the room: an error that names both, and the room.
    let error = bad(&text(r#"{ "at": [9.02, 4.1], "within": "50 mm" }"#, r#", "length": 4"#));
    assert_eq!(error.path, "placed.B");
    let told = error.to_string();
    assert!(told.contains("from O4, but link 4 makes it 4 m") && told.contains("0.05 m"), "{told}");
    // Without a room it is told that one can be stated.
    let told = bad(&text("[9.02, 4.01]", r#", "length": 4"#)).to_string();
    assert!(told.contains("within"), "{told}");
    for (b, part) in [
        (r#"{ "at": [9, 4] }"#, "`within` is missing"),
        (r#"{ "at": [9, 4], "within": 0 }"#, "greater than zero"),
        (r#"{ "at": [9], "within": 1 }"#, "expected a place"),
        (r#"{ "at": [9, 4], "whithin": 1 }"#, "did you mean `within`"),
    ] {
        let told = bad(&text(b, "")).to_string();
        assert!(told.contains(part), "{told}");
    }
}

/// Every form of the schema's list of quantities is read, and the pattern knows every head.
#[test]
fn the_list_of_quantities_is_the_readers() {
    const FORCES: [&str; 15] = [
        "F", "Fn", "Ft", "T", "drive", "load", "spring", "Fin", "Tin", "h", "FS", "moment", "arm", "Fc",
        "spin",
    ];
    let scene = r#"{ "fixed": { "O2": [0, 0], "O4": [9, 0], "O6": [20, 0] }, "near": { "A": [3, 4], "B": [9, 4] },
        "links": { "2": { "joins": ["O2", "A"], "length": 5 }, "3": { "joins": ["A", "B"], "length": 6 },
                   "4": { "joins": ["O4", "B"], "length": 4 } },
        "slides": [ { "pin": "A", "block": 6, "on": { "link": 4, "centre": "O4", "radius": 8 } } ],
        "pins": { "B": { "radius": 1 } },
        "input": { "link": 2, "angle": 53, "omega": 1 }, "find": ["QUANTITY"] }"#;
    let schema = schema();
    let pattern = schema.pointer("/$defs/quantity/pattern").unwrap().as_str().unwrap();
    for (form, meaning) in crate::scene::names_of_quantities() {
        let head = crate::scene::asked::head_of(form);
        assert!(
            ["|{}|", "({}|", "|{})"].iter().any(|place| pattern.contains(&place.replace("{}", head))),
            "{pattern}"
        );
        assert!(meaning.len() > 10);
        let scene = scene.replace("QUANTITY", form);
        if FORCES.contains(&head) {
            // Known by its name, of a scene that has forces.
            assert!(bad(&scene).what.contains("says nothing of forces"), "{form}");
            continue;
        }
        if crate::scene::cycle::CYCLE.iter().any(|(known, _)| *known == form) {
            assert!(bad(&scene).what.contains("turning-moment diagram"), "{form}");
            continue;
        }
        assert_eq!(good(&scene).mechanism.asked[0].name, form);
    }
}

/// The names of textbooks for coincident points lead to ours.
#[test]
fn coincident_points_are_offered() {
    let scene = r#"{ "fixed": { "O2": [0, 0], "O4": [0, -3] }, "placed": { "A": [4, 0], "B": [8, 3] },
        "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4", "B"] } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } } ],
        "input": { "link": 2, "omega": 1 }, "find": ["QUANTITY"] }"#;
    for (asked, meant) in [
        ("v(A4)", "did you mean `v(A@4)`, the point of link 4 that lies under A?"),
        ("a(A4)", "did you mean `a(A@4)`"),
        ("an(A4)", "did you mean `an(A@4)`"),
        ("v(A2/A4)", "`slip(A/4)`"),
        ("a(A3/A4)", "did you mean"),
        ("v(A2)", "did you mean `v(A)`?"),
        ("v(A3)", "did you mean `v(A)`?"),
        ("omega4", "write omega(3)"),
        ("vA", "write v(B)"),
        ("w(4)", "known are"),
    ] {
        let told = bad(&scene.replace("QUANTITY", asked)).to_string();
        assert!(told.contains(meant), "{asked}: {told}");
    }
}

#[test]
fn powers_may_be_written_as_on_paper() {
    let scene = |alpha: &str, unit: &str| {
        format!(
            r#"{{ "units": {{ "length": "ft" }}, "fixed": {{ "O": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O", "A"], "length": 1 }} }},
            "input": {{ "link": 2, "angle": 0, "omega": 1, "alpha": "{alpha}" }},
            "find": [ {{ "name": "a(A)", "unit": "{unit}" }} ] }}"#
        )
    };
    let usual = good(&scene("3 rad/s^2", "ft/s^2"));
    for (alpha, unit) in [("3 rad/s2", "ft/s2"), ("3 rad/s²", "ft/s²"), ("3 rad / s2", "ft / s2")] {
        let same = good(&scene(alpha, unit));
        assert_eq!(same.mechanism.asked[0].unit.symbol, "ft/s^2");
        assert_eq!(same.mechanism, usual.mechanism);
    }
    assert!(bad(&scene("3 rad/s0", "ft/s2")).to_string().contains("exponent"));
    assert!(bad(&scene("3 rad/x2", "ft/s2")).to_string().contains("`x2` is not a unit"));
}
