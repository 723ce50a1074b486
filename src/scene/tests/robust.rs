use std::fmt::Write as _;

use proptest::prelude::*;

use super::{EXAMPLE, bad, good};
use crate::scene::read;

/// Everything that a scene can have, in one text.
const FULL: &str = r#"{"title":{"en":"x"},"units":{"length":"mm","angle":"rad","time":"min"},
"fixed":{"O2":[0,0],"O4":["1 in",-300]},"placed":{"A":[30,40]},"near":{"B":[1,2]},
"links":{"2":{"joins":["O2","A"]},"3":{"joins":["A","B","C"],"sides":[30,40,50],"turn":"cw"},
"4":{"joins":["O4","D","E"],"arms":[10,20,1.5]},"5":{"joins":["C","D"],"shape":{"C":[0,0],"D":[3,4]}},"7":{"joins":["B"]}},
"slides":[{"pin":"B","block":6,"on":{"link":4,"through":"O4","toward":"D","turned":1,"offset":2}},
{"link":5,"turned":0.5,"on":{"link":1,"through":[1,2],"angle":"30 deg"}},{"pin":"E","on":{"link":1,"centre":[0,0],"radius":9}}],
"rolls":[{"links":[2,7],"centres":["A","B"],"teeth":[20,30],"module":6,"internal":true},
{"links":[1,7],"line":{"through":"O4"},"centre":"B","radius":3}],
"inputs":[{"link":2,"omega":"75 rpm cw","alpha":3},{"slide":6,"at":3,"velocity":-1e3}],
"find":["v(B)","slip(B/4)",{"name":"omega(3)","unit":"deg/s"},"rub(B,3/7)","I(2,3)"],
"pins":{"B":{"diameter":"5 mm"}},"published":{"v(B)":{"value":"3 cm/s","within":"5 %"}},"errata":["v(B)"],
"expect":"indeterminate","sheet":{"scales":{"velocity":"5 per cm"},"figures":[]}}"#;

#[test]
fn the_full_scene_is_good() {
    good(FULL);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Whatever happens to the bytes of a scene, the reader answers.
    #[test]
    fn mutated_bytes_never_panic(
        full in any::<bool>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4usize), 1..8),
    ) {
        let mut bytes = if full { FULL } else { EXAMPLE }.as_bytes().to_vec();
        for (place, byte, kind) in edits {
            let index = place.index(bytes.len());
            match kind {
                0 => bytes[index] = byte,
                1 => { bytes.remove(index); }
                2 => bytes.insert(index, byte),
                // Digits and structure make more scenes that are still JSON.
                _ => bytes[index] = b"0123456789eE-.,:[]{}\"/ AB"[usize::from(byte) % 25],
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        if let Err(error) = read(&text, "s") {
            prop_assert!(error.line >= 1 && error.column >= 1);
            prop_assert!(!error.what.is_empty());
        }
    }

    /// Words exchanged for other words of the format keep a text JSON and reach the later steps.
    #[test]
    fn shuffled_words_never_panic(swaps in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..6)) {
        let mut words: Vec<&str> = FULL.split_inclusive([',', ':', '{', '}', '[', ']']).collect();
        for (from, to) in swaps {
            let (from, to) = (from.index(words.len()), to.index(words.len()));
            let last = |i: usize| words[i].chars().last();
            if last(from) == last(to) {
                words[to] = words[from];
            }
        }
        if let Ok(scene) = read(&words.concat(), "s") {
            for point in &scene.mechanism.points {
                let finite = point.place.hint().is_none_or(|p| p.iter().all(|c| c.is_finite()));
                prop_assert!(finite, "{}", point.name);
            }
        }
    }
}

#[test]
fn long_chains_are_read_and_longer_ones_refused() {
    let chain = |count: usize| {
        let mut links = String::new();
        for i in 2..count + 2 {
            let comma = if i > 2 { "," } else { "" };
            write!(links, r#"{comma}"{i}":{{"joins":["P{}","P{i}"],"length":1}}"#, i - 1).unwrap();
        }
        format!(r#"{{"fixed":{{"P1":[0,0]}},"links":{{{links}}},"input":{{"link":2,"angle":0}}}}"#)
    };
    let scene = good(&chain(200));
    assert_eq!(scene.mechanism.links.len(), 201);
    assert_eq!(scene.mechanism.pins.len(), 200);
    assert_eq!(scene.mechanism.asked.len(), 2 * 200 + 2 * 200);
    assert!(bad(&chain(10_001)).what.contains("more than 10000"));
    assert!(bad(&chain(10_000)).what.contains("more than 10000 points"));
    good(&chain(9_999));
}

#[test]
fn crowds_of_placed_points_take_no_time() {
    let (mut joins, mut places) = (String::new(), String::new());
    for i in 0..5000 {
        let comma = if i > 0 { "," } else { "" };
        write!(joins, r#"{comma}"P{i}""#).unwrap();
        write!(places, r#"{comma}"P{i}":[{i},{}]"#, i % 7).unwrap();
    }
    let text = format!(
        r#"{{"placed":{{{places}}},"links":{{"2":{{"joins":[{joins}]}},"3":{{"joins":[{joins}],"shape":{{{places}}}}}}}}}"#
    );
    let scene = good(&text);
    assert_eq!(scene.mechanism.points.len(), 5000);
}
