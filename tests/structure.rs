//! Mobility by count against the worked counts of the sources, groups in order of transmission, and the
//! named errors.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use linkgram::mechanism::structure::{GroupKind, Joint, Structure, StructureError};
use linkgram::scene::Scene;

fn structure(scene: &Scene) -> Structure {
    Structure::of(&scene.mechanism).unwrap()
}

/// Kinds of the groups with the numbers of their links, in order.
fn groups(scene: &Scene) -> Vec<(String, Vec<u32>)> {
    let links = |ids: &[linkgram::mechanism::LinkId]| -> Vec<u32> {
        ids.iter().map(|&l| scene.mechanism.link(l).number).collect()
    };
    structure(scene).groups.iter().map(|g| (g.kind.to_string(), links(&g.links))).collect()
}

fn named(list: &[(&str, &[u32])]) -> Vec<(String, Vec<u32>)> {
    list.iter().map(|(kind, links)| ((*kind).to_owned(), links.to_vec())).collect()
}

/// Case s000-ch1-2-4, worked in the source: n = 8, four double joints, p = 10, F = 1.
const PEAUCELLIER: &str = r#"{
  "fixed": { "A": [2, 0], "B": [0, 0] },
  "links": {
    "2": { "joins": ["A", "E"], "length": 2 },
    "3": { "joins": ["B", "C"], "length": 6 }, "4": { "joins": ["B", "D"], "length": 6 },
    "5": { "joins": ["E", "C"], "length": 3 }, "6": { "joins": ["E", "D"], "length": 3 },
    "7": { "joins": ["C", "P"], "length": 3 }, "8": { "joins": ["D", "P"], "length": 3 }
  },
  "near": { "C": [5, 3], "D": [5, -1], "P": [7, 1] },
  "input": { "link": 2, "angle": 20, "omega": 1 }
}"#;

#[test]
fn peaucellier_has_ten_pairs_and_one_freedom() {
    let scene = common::read(PEAUCELLIER);
    let mobility = structure(&scene).mobility;
    assert_eq!((mobility.links, mobility.turning, mobility.sliding, mobility.higher), (8, 10, 0, 0));
    assert_eq!((mobility.freedoms, mobility.inputs), (1, 1));
    let text = mobility.to_string();
    assert!(text.contains("n = 8") && text.contains("3(8 - 1) - 2*10 - 0 = 1"), "{text}");
    let expected = named(&[("driver", &[2]), ("RRR", &[3, 5]), ("RRR", &[4, 6]), ("RRR", &[7, 8])]);
    assert_eq!(groups(&scene), expected);
}

/// Case s000-ch1-2-5: n = 5, F = 2 (the printed p = 8 is an erratum; the figure has 5 pairs).
fn pantograph(inputs: &str) -> Scene {
    common::read(&format!(
        r#"{{
          "fixed": {{ "A": [0, 0] }},
          "links": {{
            "2": {{ "joins": ["A", "B"], "length": 3 }}, "3": {{ "joins": ["B", "C", "D"], "line": [0, 2, 4] }},
            "4": {{ "joins": ["C", "E"], "length": 3 }}, "5": {{ "joins": ["A", "E"], "length": 2 }}
          }},
          "near": {{ "C": [4, 2] }},
          {inputs}
        }}"#
    ))
}

#[test]
fn the_pantograph_has_five_pairs_and_two_freedoms() {
    let scene = pantograph(
        r#""inputs": [ { "link": 2, "angle": 70, "omega": 1 }, { "link": 5, "angle": 10, "omega": 0 } ]"#,
    );
    let mobility = structure(&scene).mobility;
    assert_eq!((mobility.links, mobility.turning, mobility.freedoms), (5, 5, 2));
    assert_eq!(groups(&scene), named(&[("driver", &[2]), ("driver", &[5]), ("RRR", &[3, 4])]));
}

#[test]
fn one_input_leaves_a_freedom_of_the_pantograph_over() {
    let scene = pantograph(r#""input": { "link": 2, "angle": 70, "omega": 1 }"#);
    let error = Structure::of(&scene.mechanism).unwrap_err();
    let StructureError::UnderConstrained { left, links, mobility } = &error else { panic!("{error}") };
    assert_eq!((*left, links.as_slice(), mobility.freedoms), (1, [3, 4, 5].as_slice(), 2));
    let text = error.to_string();
    assert!(text.starts_with("1 degree of freedom left over: links 3, 4, 5 not driven"), "{text}");
}

/// Case s000-ch1-2-7, the differential, as its planar equivalent: the crown 3 turns coaxially with the sun
/// 5 and the ring 6 and carries the planet 4. Turning pairs 1-2, 3-4, 1-6, 3-5 (as 1-3), 1-5; gear pairs
/// 2-3, 4-5, 4-6. n = 6, p1 = 5, p2 = 3, F = 2.
#[test]
fn the_differential_has_two_freedoms() {
    let scene = common::read(
        r#"{
          "fixed": { "O": [0, 0], "O2": [50, 0] },
          "links": {
            "2": { "joins": ["O2"] }, "3": { "joins": ["O", "P"], "length": 30 },
            "4": { "joins": ["P"] }, "5": { "joins": ["O"] }, "6": { "joins": ["O"] }
          },
          "rolls": [
            { "links": [2, 3], "centres": ["O2", "O"], "radii": [10, 40] },
            { "links": [4, 5], "centres": ["P", "O"], "radii": [10, 20] },
            { "links": [4, 6], "centres": ["P", "O"], "radii": [10, 40], "internal": true }
          ],
          "inputs": [ { "link": 3, "angle": 0, "omega": 1 }, { "link": 5, "omega": 2 } ],
          "find": ["omega(6)"]
        }"#,
    );
    let mobility = structure(&scene).mobility;
    assert_eq!((mobility.links, mobility.turning, mobility.higher), (6, 5, 3));
    assert_eq!(mobility.freedoms, 2);
}

#[test]
fn the_four_bar_and_the_slider_crank_have_one_freedom() {
    // 3·3 − 2·4 = 1 in both: the sources' minimum count for lower pairs.
    let four_bar = structure(&common::example("s000-ch4-2-30-root1")).mobility;
    assert_eq!((four_bar.links, four_bar.turning, four_bar.sliding, four_bar.freedoms), (4, 4, 0, 1));
    let slider = structure(&common::example("s000-ch4-1")).mobility;
    assert_eq!((slider.links, slider.turning, slider.sliding, slider.freedoms), (4, 3, 1, 1));
}

#[test]
fn a_pin_in_a_bare_slot_is_a_higher_pair() {
    let text = common::example_text("s000-ch4-1").replace(r#""block": 4, "#, "");
    let mobility = structure(&common::read(&text)).mobility;
    assert_eq!((mobility.links, mobility.turning, mobility.sliding, mobility.higher), (3, 2, 0, 1));
    assert_eq!(mobility.freedoms, 1);
}

#[test]
fn problem_3_1_is_driver_rrr_rrp() {
    let scene = common::example("s000-ch3a-1");
    assert_eq!(groups(&scene), named(&[("driver", &[2]), ("RRR", &[3, 4]), ("RRP", &[5, 6])]));
    let structure = structure(&scene);
    let point = |name: &str| scene.mechanism.point_named(name).unwrap();
    let GroupKind::Rrr { bases, pin, .. } = structure.groups[1].kind else { panic!() };
    assert_eq!((bases, pin), ([point("A"), point("O4")], point("B")));
    let GroupKind::Rrp { base, pin, slide, .. } = structure.groups[2].kind else { panic!() };
    assert_eq!((base, pin, slide), (point("C"), point("D"), 0));
    assert_eq!(structure.groups[1].after, vec![0]);
    assert_eq!(structure.groups[2].after, vec![1]);
    assert_eq!(structure.mobility.freedoms, 1);
}

#[test]
fn the_eight_link_chain_is_driver_rrr_and_two_rrp() {
    let scene = common::example("eight-link");
    let expected = named(&[("driver", &[2]), ("RRR", &[3, 4]), ("RRP", &[5, 6]), ("RRP", &[7, 8])]);
    assert_eq!(groups(&scene), expected);
    let structure = structure(&scene);
    assert_eq!((structure.mobility.links, structure.mobility.freedoms), (8, 1));
    // Both rods depend on the group of the coupler, and neither on the other.
    assert_eq!(structure.groups[2].after, vec![1]);
    assert_eq!(structure.groups[3].after, vec![1]);
}

#[test]
fn a_pin_of_four_links_counts_three_pairs() {
    // The crank's pin A carries the crank and three rods.
    let scene = common::read(
        r#"{
          "fixed": { "O2": [0, 0], "O4": [60, 0], "O5": [0, 60], "O6": [-60, 0] },
          "links": {
            "2": { "joins": ["O2", "A"], "length": 15 },
            "3": { "joins": ["A", "B"], "length": 50 }, "4": { "joins": ["O4", "B"], "length": 40 },
            "5": { "joins": ["A", "C"], "length": 50 }, "6": { "joins": ["O5", "C"], "length": 40 },
            "7": { "joins": ["D", "A"], "length": 50 }, "8": { "joins": ["D", "O6"], "length": 40 }
          },
          "near": { "B": [50, 40], "C": [40, 50], "D": [-50, 40] },
          "input": { "link": 2, "angle": 40, "omega": 1 }
        }"#,
    );
    let a = scene.mechanism.point_named("A").unwrap();
    assert_eq!(scene.mechanism.pins.iter().filter(|p| p.point == a).count(), 3);
    let structure = structure(&scene);
    assert_eq!((structure.mobility.turning, structure.mobility.freedoms), (10, 1));
    let expected = named(&[("driver", &[2]), ("RRR", &[3, 4]), ("RRR", &[5, 6]), ("RRR", &[7, 8])]);
    assert_eq!(groups(&scene), expected);
    assert!(structure.groups[1..].iter().all(|g| g.after == [0]));
}

#[test]
fn order_is_that_of_transmission_not_of_numbers() {
    // Links 3 and 4 depend on the rocker 6, so they come after 5 and 6.
    let scene = common::read(
        r#"{
          "fixed": { "O2": [0, 0], "O6": [60, 0], "O4": [120, 0] },
          "links": {
            "2": { "joins": ["O2", "A"], "length": 15 },
            "3": { "joins": ["B", "C"], "length": 60 }, "4": { "joins": ["O4", "C"], "length": 40 },
            "5": { "joins": ["A", "B"], "length": 50 }, "6": { "joins": ["O6", "B"], "length": 40 }
          },
          "near": { "B": [50, 40], "C": [110, 40] },
          "input": { "link": 2, "angle": 40, "omega": 1 }
        }"#,
    );
    assert_eq!(groups(&scene), named(&[("driver", &[2]), ("RRR", &[5, 6]), ("RRR", &[3, 4])]));
}

fn over(scene: &Scene) -> (String, Joint, String) {
    match Structure::of(&scene.mechanism).unwrap_err() {
        error @ StructureError::OverConstrained { .. } => {
            let text = error.to_string();
            let StructureError::OverConstrained { what, joint, .. } = error else { unreachable!() };
            (what, joint, text)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_second_input_on_a_four_bar_is_named() {
    let text = common::example_text("s000-ch4-2-30-root1").replace(
        r#""input": { "link": 2, "angle": 30, "omega": "10 rad/s ccw", "alpha": "30 rad/s^2 cw" }"#,
        r#""inputs": [ { "link": 2, "angle": 30, "omega": 10 }, { "link": 4, "angle": 80, "omega": 1 } ]"#,
    );
    let (what, joint, text) = over(&common::read(&text));
    assert_eq!((what.as_str(), joint), ("the input of link 4", Joint::Input(1)));
    assert!(text.contains("one constraint too many") && text.contains("F = 3(4 - 1)"), "{text}");
}

/// The count does not tell directions from places: a link that slides without turning cannot be turned, nor can two
/// links be that turn as one.
#[test]
fn the_angle_of_what_cannot_turn_is_one_too_many() {
    let ride = r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["A", "B"] } }, "placed": { "A": [1, 0], "B": [2, 3] },
        "slides": [ { "link": 2, "on": { "link": 1, "through": "O" } } ], "input": { "link": 2, "omega": 5 } }"#;
    let (what, joint, text) = over(&common::read(ride));
    assert_eq!(joint, Joint::Input(0));
    assert_eq!(what, "the input of link 2, which cannot turn,");
    assert!(text.contains("one constraint too many"), "{text}");
    let together = r#"{ "fixed": { "O": [0, 0] }, "placed": { "A": [3, 0], "C": [1, 0], "D": [1, 2] },
        "links": { "2": { "joins": ["O", "A"] }, "3": { "joins": ["C", "D"] } },
        "slides": [ { "link": 3, "on": { "link": 2, "through": "O", "toward": "A" } } ],
        "inputs": [ { "link": 2, "omega": 5 }, { "link": 3, "omega": 5 } ] }"#;
    let (what, joint, _) = over(&common::read(together));
    assert_eq!(joint, Joint::Input(1));
    assert_eq!(what, "the input of link 3, which turns only with link 2, itself driven,");
}

#[test]
fn a_rigid_frame_has_no_freedom_for_its_input() {
    let scene = common::read(
        r#"{
          "fixed": { "O2": [0, 0], "O3": [40, 0] },
          "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["O3", "A"], "length": 30 } },
          "near": { "A": [20, 20] },
          "input": { "link": 2, "angle": 50, "omega": 1 }
        }"#,
    );
    let (what, joint, _) = over(&scene);
    assert_eq!((what.as_str(), joint), ("the input of link 2", Joint::Input(0)));
}

#[test]
fn a_second_rod_between_two_links_is_named() {
    // A parallel rod moves in fact, by its special lengths; the count must still say so.
    let scene = common::read(
        r#"{
          "fixed": { "O2": [0, 0], "O4": [60, 0] },
          "links": {
            "2": { "joins": ["O2", "A", "C"], "line": [0, 30, 20] },
            "3": { "joins": ["A", "B"], "length": 60 },
            "4": { "joins": ["O4", "B", "D"], "line": [0, 30, 20] },
            "5": { "joins": ["C", "D"], "length": 60 }
          },
          "near": { "B": [80, 25] },
          "input": { "link": 2, "angle": 50, "omega": 1 }
        }"#,
    );
    let (_, _, text) = over(&scene);
    assert!(text.contains("= 0"), "3·4 − 2·6 = 0: {text}");
}

#[test]
fn loose_links_are_named() {
    let scene = common::read(
        r#"{
          "fixed": { "O2": [0, 0] },
          "links": {
            "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 30 },
            "4": { "joins": ["B", "C"], "length": 30 }
          },
          "input": { "link": 2, "angle": 50, "omega": 1 }
        }"#,
    );
    let StructureError::UnderConstrained { left, links, .. } = Structure::of(&scene.mechanism).unwrap_err()
    else {
        panic!()
    };
    assert_eq!((left, links), (2, vec![3, 4]));
}

#[test]
fn links_that_slide_without_turning_are_known_either_way_round() {
    type Groups<'a> = &'a [(&'a str, &'a [u32])];
    let kinds: &[(&str, Groups<'_>)] = &[
        ("oldham", &[("driver", &[2]), ("RPP", &[3, 4])]),
        ("riding-link", &[("driver", &[2]), ("RRP", &[3, 4])]),
        ("riding-link-on-slot", &[("driver", &[2]), ("PRP", &[3, 4])]),
        ("links-on-two-guides", &[("driver", &[2]), ("driver", &[3]), ("PRP", &[4, 5])]),
        ("curved-yoke", &[("driver", &[2]), ("PPR", &[3, 4])]),
        ("reversed-yoke", &[("driver", &[2]), ("driver", &[3]), ("PPR", &[4, 5])]),
        ("rack", &[("driver", &[2]), ("rack", &[3])]),
        ("driven-wheel", &[("driven wheel", &[2]), ("RRP", &[3, 4])]),
        ("trammel-driven-by-bar", &[("driven bar", &[2, 3, 4])]),
        ("coupler-driven", &[("driven bar", &[2, 3, 4])]),
    ];
    for (name, expected) in kinds {
        assert_eq!(groups(&common::example(&format!("pairs/{name}"))), named(expected), "{name}");
    }
}

/// A rack that slides on the frame beside its pinion touches it without a constraint of its own; the wheel
/// that rolls at the end of a rod needs one.
#[test]
fn only_what_nothing_else_holds_is_held_by_its_contact() {
    let mobility = structure(&common::example("pairs/rack")).mobility;
    assert_eq!((mobility.rolling, mobility.higher, mobility.freedoms), (0, 1, 1));
    let mobility = structure(&common::example("pairs/wheel-on-plane")).mobility;
    assert_eq!((mobility.rolling, mobility.higher, mobility.freedoms), (1, 0, 1));
}
