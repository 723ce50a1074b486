//! What a sheet tells, in which order: a table takes as known what was told before it, each asked quantity has a line that
//! derives it, a line uses what an earlier one gave, and one quantity has one printed value. Read off the ink of the sheets.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;
use crate::legibility::{all, characters, data, has, number, sentences, within};

use std::collections::{BTreeMap, BTreeSet, HashSet};

use linkgram::drawing;
use linkgram::plan::Extent;
use linkgram::sheet::figure::{Group, Node, Text};
use linkgram::sheet::{self, Figure, Language};

fn texts(group: &Group) -> impl Iterator<Item = &Text> {
    group.children.iter().filter_map(|node| match node {
        Node::Text(text) => Some(text),
        _ => None,
    })
}

/// The cells of a table, row by row: where each begins and ends, and what stands there.
fn rows(table: &Group) -> Vec<Vec<([f64; 2], String)>> {
    let mut rows: BTreeMap<i64, Vec<([f64; 2], String)>> = BTreeMap::new();
    for text in texts(table) {
        let Some(first) = text.runs.first() else { continue };
        let base = text.runs.iter().filter(|run| run.size >= 0.9 * first.size).map(|run| run.at.y);
        let y = base.fold(first.at.y, f64::max);
        let from = text.runs.iter().map(|run| run.at.x).fold(f64::INFINITY, f64::min);
        let to = text.runs.iter().map(|run| run.at.x + 0.5 * run.size * run.text.chars().count() as f64);
        let to = to.fold(from, f64::max);
        rows.entry((y * 4.0).round() as i64).or_default().push(([from, to], characters(text)));
    }
    rows.into_values().collect()
}

/// The terms of a table of an equation: the symbol, and what stands under it as its magnitude; and the unit.
fn terms(table: &Group) -> (String, Vec<(String, String)>) {
    let rows = rows(table);
    let Some([head, magnitudes]) = rows.first_chunk::<2>() else { return Default::default() };
    let unit = magnitudes.iter().find_map(|(_, text)| text.split_once(", ").map(|(_, unit)| unit.to_owned()));
    let is_near = |a: &[f64; 2], b: &[f64; 2]| (a[0] + a[1] - b[0] - b[1]).abs() / 2.0 < 4.0;
    let under = |(place, symbol): &([f64; 2], String)| {
        let own = magnitudes.iter().find(|(at, text)| is_near(at, place) && number(text).is_some())?;
        Some((symbol.clone(), own.1.clone()))
    };
    (unit.unwrap_or_default(), head.iter().filter_map(under).collect())
}

/// A coupler that is driven, a slider on its one end and a rocker on the other.
pub(crate) const DRIVEN_ROD: &str = r#"{"units": {"length": "cm"}, "fixed": {"O2": [0.0, 0.0]}, "links": {"4": {"joins": ["O2", "A", "C"],
    "shape": {"O2": [-2.829, 3.809], "A": [-2.352, -0.791], "C": [-2.181, -0.138]}}, "3": {"joins": ["A",
    "B", "D"], "shape": {"A": [0.601, 6.807], "B": [7.86, 16.187], "D": [1.967, 17.417]}}},
    "near": {"A": [4.1, -2.2], "B": [10.0, 8.1], "C": [3.6, -1.7], "D": [4.0, 8.5]}, "slides": [{"pin": "B",
    "block": 2, "on": {"link": 1, "through": [-0.407, 1.204], "angle": 213.3}}], "input": {"link": 3,
    "angle": 59.84, "omega": "10.44 rad/s cw"}, "masses": {"4": {"mass": 2.95, "at": "C",
    "inertia": 0.0016}, "3": {"mass": 2.4, "at": [-2.8, -0.3], "inertia": 0.0156}, "2": {"mass": 0.92}},
    "loads": [{"on": 4, "torque": 18.2}, {"on": 3, "at": "D", "force": [195.9, -219.7]}], "find": ["v(D)",
    "Tin(3)", "F(4,3)", "moment(F(1,4),O2)", "T(3)", "v(A)", "F(3,2)", "Fin(2)", "x(D)", "alpha(3)", "a(D)",
    "Tin(4)", "moment(F(1,2),O2)", "F(frame)", "Fin(4)", "Fin(3)", "angle(4)", "v(B)", "a(A)",
    "moment(F(4,3),O2)", "omega(4)", "a(B)", "a(C)", "alpha(4)", "x(C)", "moment(F(3,2),O2)", "x(A)",
    "v(C)", "F(1,4)", "x(B)", "angle(3)", "F(1,2)", "omega(3)"]}"#;

/// A four-bar clamp with a torque that is sought on its crank.
pub(crate) const CLAMP: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [120, 0]}, "links": {"2": {"joins": ["O2",
    "A"], "length": 60}, "3": {"joins": ["A", "B", "H"], "line": [0, 80, 260]}, "4": {"joins": ["O4", "B"],
    "length": 70}}, "near": {"B": [95, 62]}, "input": {"link": 2, "angle": 75, "omega": "1 rad/s cw"},
    "loads": [{"on": 3, "at": "H", "force": "150 N", "direction": -90, "name": "P"}, {"on": 2,
    "torque": "?", "name": "M"}], "find": ["load(M)", "F(3,4)", "F(1,2)", "F(2,3)"]}"#;

/// Sheets with pairs and forces of every kind besides those whose looks are judged.
fn sheets() -> Vec<(String, Figure)> {
    let folder = common::root().join("examples");
    let more = ["forces", "exam"].iter().flat_map(|name| std::fs::read_dir(folder.join(name)).unwrap());
    let more = more.map(|entry| entry.unwrap().path());
    let more = more.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    let mut all = all();
    for path in more {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(&path).unwrap();
        let Ok(scene) = linkgram::scene::read(&text, &name) else { continue };
        let Ok(solved) = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene)
        else {
            continue;
        };
        all.push((name, sheet::solution(&scene, &solved.solution.construction, Language::English)));
    }
    for (name, text) in [("driven rod", DRIVEN_ROD), ("clamp", CLAMP)] {
        let scene = common::read(text);
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        all.push((
            name.to_owned(),
            sheet::solution(&scene, &solved.solution.construction, Language::English),
        ));
    }
    all
}

/// The torque of a driven rod hangs on the forces that its polygon gives, and a torque that is sought on a crank on that of
/// the crank's pin: each is told after what it uses, by moments and without a trial.
#[test]
fn a_torque_is_told_after_the_forces_on_which_it_hangs() {
    let sheets = sheets();
    let lines = |name: &str| sentences(&sheets.iter().find(|(own, _)| own == name).unwrap().1);
    let place = |lines: &[String], what: &str| lines.iter().position(|line| line.contains(what));
    let rod = lines("driven rod");
    let read = place(&rod, "Read F_43").unwrap();
    let torque = place(&rod, "T_3\u{a0}=").unwrap();
    assert!(read < torque, "{rod:#?}");
    let clamp = lines("clamp");
    assert!(place(&clamp, "M\u{a0}= F_32\u{a0}·").is_some(), "{clamp:#?}");
    assert!(clamp.iter().all(|line| !line.contains("In proportion")), "{clamp:#?}");
}

/// The symbol of a velocity or an acceleration of a point, or of a rate of a link.
fn is_symbol(text: &str) -> bool {
    let mut all = text.chars();
    let is_rate = match all.next() {
        Some('V' | 'A') => false,
        Some('ω' | 'α' | 'ε') => true,
        _ => return false,
    };
    let index = all.as_str().split_once('_').map(|(_, index)| index).and_then(|index| index.chars().next());
    let marked = all.as_str().starts_with(['_', '^']);
    let indexed = index.is_some_and(|first| if is_rate { first.is_numeric() } else { first.is_uppercase() });
    marked && indexed && !text.contains([' ', '\u{a0}', ',', '×', '·', '/'])
}

/// A token of a formula as a symbol of the motion: without brackets and squares.
fn symbol(token: &str) -> Option<String> {
    let token = token.trim_matches(['(', ')', '|', '.', ',', ';', ':']).replace("^2", "").replace('²', "");
    is_symbol(&token).then_some(token)
}

#[test]
fn no_checked_vector_stands_beside_a_value_that_is_not_its_own() {
    let (mut compared, mut wrong) = (0, Vec::new());
    for (name, figure) in sheets() {
        let groups = within(&figure.root);
        let names = groups.iter().filter(|group| has(group, "name"));
        let names: Vec<(&str, String)> = names
            .flat_map(|group| {
                let text: String = texts(group).map(characters).collect();
                data(group, "of").unwrap_or_default().split(' ').map(move |of| (of, text.clone()))
            })
            .collect();
        let vectors: Vec<(&str, &str, f64)> = groups
            .iter()
            .filter(|group| has(group, "vector"))
            .filter_map(|group| {
                Some((data(group, "quantity")?, data(group, "from")?, data(group, "value")?.parse().ok()?))
            })
            .collect();
        for table in groups.iter().filter(|group| has(group, "terms")) {
            for (symbol, printed) in terms(table).1 {
                let of: HashSet<&str> =
                    names.iter().filter(|(_, text)| *text == symbol).map(|(of, _)| *of).collect();
                // A point under a pin bears one name against the frame and against a point of its link: in a table it
                // stands for the first.
                let whole = |quantity: &str, from: &str| !quantity.contains('@') || from.starts_with('o');
                // One that names that point too, V_A4A, is what stands against it.
                let letters = symbol.trim_end_matches(char::is_alphabetic);
                let against =
                    letters.len() < symbol.len() && letters.ends_with(|last: char| last.is_ascii_digit());
                let own = vectors.iter().filter(|(quantity, ..)| of.contains(quantity));
                let parted = |quantity: &str| ["an(", "at("].iter().any(|part| quantity.starts_with(part));
                let own: Vec<f64> = own
                    .filter(|(quantity, from, _)| parted(quantity) || whole(quantity, from) != against)
                    .map(|(.., value)| *value)
                    .collect();
                let Some((printed, ..)) = number(&printed).filter(|_| !own.is_empty()) else { continue };
                compared += 1;
                // Readings that are carried on are off by less.
                if !own.iter().any(|value| (value - printed).abs() <= 0.01 * value.max(printed)) {
                    wrong.push(format!("{name}: {symbol} {printed}, drawn {own:?}"));
                }
            }
        }
    }
    println!("{compared} terms");
    assert!(compared > 150, "{compared}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn each_asked_quantity_has_a_line_that_derives_it() {
    let (mut asked, mut missing) = (0, Vec::new());
    for (name, figure) in sheets() {
        let told: Vec<String> = sentences(&figure);
        let groups = within(&figure.root);
        let results = groups.iter().filter(|group| has(group, "results"));
        let symbols: BTreeSet<String> =
            results.flat_map(|group| texts(group).map(characters)).filter(|text| is_symbol(text)).collect();
        for symbol in symbols {
            asked += 1;
            // Against a pivot of the frame a point has no velocity but its own.
            let pivot = symbol.rsplit_once('O').filter(|(_, number)| number.chars().all(char::is_numeric));
            let own = pivot.map_or(symbol.as_str(), |(own, _)| own);
            let names = |line: &str, own: &str| {
                line.match_indices(own).any(|(at, _)| {
                    let after = line[at + own.len()..].chars().next();
                    after.is_none_or(|next| !next.is_alphanumeric() && next != '_' && next != '^')
                })
            };
            let derives = |line: &String| names(line, own) || names(line, &symbol);
            if !told.iter().any(derives) {
                missing.push(format!("{name}: {symbol}"));
            }
        }
    }
    println!("{asked} asked");
    assert!(asked > 400, "{asked}");
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn what_a_line_uses_was_told_before_it() {
    let (mut used, mut early) = (0, Vec::new());
    for (name, figure) in sheets() {
        let mut known: HashSet<String> = HashSet::from(["ω_1".to_owned()]);
        let given = within(&figure.root).into_iter().flat_map(texts).filter(|text| text.class == "given");
        let given: String = given.map(|text| characters(text) + " ").collect();
        let lines = std::iter::once(given).chain(sentences(&figure));
        for line in lines {
            let mut line = line.replace('\u{a0}', " ");
            // The number of a link beside a point's name is no bracket of a formula.
            for link in 1..=9 {
                line = line.replace(&format!("({link})"), &format!("_{link}"));
            }
            let parts: Vec<&str> = line.split('=').collect();
            for part in &parts[1..] {
                let formula = [" · ", " / ", "−", "+", "|", "^2"].iter().any(|sign| part.contains(sign));
                if !formula || number(part).is_some() || part.contains(',') {
                    continue;
                }
                for symbol in part.split([' ', '|', '(', ')']).filter_map(symbol) {
                    used += 1;
                    if !known.contains(&symbol) {
                        early.push(format!("{name}: {symbol} in {line}"));
                        known.insert(symbol);
                    }
                }
            }
            let ends = parts.iter().take(parts.len() - 1);
            known.extend(ends.filter_map(|part| symbol(part.split_whitespace().last()?)));
            known.extend(line.split_whitespace().next().and_then(symbol));
        }
    }
    println!("{used} uses");
    assert!(used > 500, "{used}");
    assert!(early.is_empty(), "{early:#?}");
}

#[test]
fn one_quantity_has_one_printed_value() {
    let (mut values, mut many) = (0, Vec::new());
    for (name, figure) in sheets() {
        let mut printed: BTreeMap<(String, String), Vec<(f64, String)>> = BTreeMap::new();
        let mut note = |symbol: &str, text: &str, unit: Option<&str>| {
            let Some((value, _, rest)) = number(text) else { return };
            let unit =
                unit.map_or_else(|| rest.split([' ', '\u{a0}', ',', ';', '.']).find(|s| !s.is_empty()), Some);
            let Some(unit) = unit else { return };
            let all = printed.entry((symbol.to_owned(), unit.to_owned())).or_default();
            if all.iter().all(|(other, _)| (other - value).abs() > 1e-9 * value.abs()) {
                all.push((value, text.to_owned()));
            }
        };
        for table in within(&figure.root).into_iter().filter(|group| has(group, "terms")) {
            let (unit, terms) = terms(table);
            terms.iter().for_each(|(symbol, text)| note(symbol, text, Some(&unit)));
        }
        // Klein's construction has readings of its own.
        for line in sentences(&figure).iter().take_while(|line| !line.contains("Klein")) {
            let parts: Vec<&str> = line.split('=').collect();
            let [first, .., last] = parts.as_slice() else { continue };
            let symbol = first.trim().trim_start_matches("Read ").trim();
            let is_force = symbol.starts_with(['P', 'F', 'h']) && !symbol.contains([' ', '\u{a0}']);
            if is_symbol(symbol) || is_force {
                note(symbol, last, None);
            }
        }
        values += printed.len();
        for ((symbol, unit), all) in printed.iter().filter(|(_, all)| all.len() > 1) {
            many.push(format!("{name}: {symbol} in {unit}: {all:?}"));
        }
    }
    println!("{values} values");
    assert!(values > 800, "{values}");
    assert!(many.is_empty(), "{many:#?}");
}

/// A block is driven along the guide of a link that turns: what is given is its velocity against that link.
#[test]
fn a_driven_slide_on_a_moving_link_is_given_against_it() {
    let text = r#"{
        "title": "Hydraulic cylinder", "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O4": [600, -100] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 700 }, "3": { "joins": ["O4", "K"], "length": 500 }
        },
        "slides": [{ "pin": "A", "block": 4, "on": { "link": 3, "through": "O4", "toward": "K" } }],
        "near": { "A": [500, 480] },
        "input": { "slide": "A", "at": 580, "velocity": "60 mm/s" },
        "find": ["omega(2)", "omega(3)", "v(A)"]
    }"#;
    let scene = linkgram::scene::read(text, "cylinder.json");
    let scene = scene.unwrap_or_else(|error| panic!("{error:?}"));
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
    let given = within(&figure.root).into_iter().flat_map(texts).filter(|text| text.class == "given");
    let given: String = given.map(|text| characters(text) + " ").collect();
    assert!(given.replace('\u{a0}', " ").contains("V_A2A3 = 60"), "{given}");
}

/// A rod runs through a sleeve that swivels on the frame: what its turning gives to its point in the sleeve is told against
/// the joint about which it turns. Taken for the whole vector of that point, of which the sheet tells as well, the equation
/// would not close: V_E4 = 0 = V_A + V_E3A + V_E4E3, and V_E3 = V_A + V_E3A.
#[test]
fn what_turning_gives_is_told_against_the_joint_about_which_it_turns() {
    let scene = common::read(
        r#"{
            "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "E": [22, -4] },
            "links": {
                "2": { "joins": ["O2", "A"], "length": 8 }, "3": { "joins": ["A", "B"], "length": 34 }
            },
            "slides": [{ "pin": "E", "block": 4, "on": { "link": 3, "through": "A", "toward": "B" } }],
            "near": { "B": [32, -10] },
            "input": { "link": 2, "angle": 105, "omega": "12 rad/s ccw" }, "find": ["omega(3)", "alpha(3)"]
        }"#,
    );
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
    let heads: Vec<Vec<String>> = within(&figure.root)
        .into_iter()
        .filter(|group| has(group, "terms"))
        .filter_map(|table| rows(table).into_iter().next())
        .map(|row| {
            row.into_iter().map(|(_, text)| text).filter(|text| !"=+".contains(text.as_str())).collect()
        })
        .collect();
    assert_eq!(heads.len(), 2, "{heads:?}");
    assert_eq!(heads[0], ["V_E4", "V_A", "V_E3A", "V_E4E3"]);
    let accelerations = heads[1].join(" ");
    for part in ["A^n_E3A", "A^t_E3A"] {
        assert!(accelerations.contains(part), "{accelerations}");
    }
}

/// On a question an arrow shows which way a slide is driven: what is told is how fast, without a sign that would turn the arrow
/// about, and the acceleration is told by the arrow.
#[test]
fn the_arrow_of_a_question_is_not_turned_about_by_a_sign() {
    let told = |velocity: &str, acceleration: &str| {
        let scene = common::read(&format!(
            r#"{{
                "units": {{ "length": "cm" }}, "fixed": {{ "W": [0, 0] }},
                "links": {{ "3": {{ "joins": ["A", "B"], "length": 40 }} }},
                "slides": [
                    {{ "pin": "A", "block": 2, "on": {{ "link": 1, "through": "W", "angle": 0 }} }},
                    {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "W", "angle": 110 }} }}
                ],
                "near": {{ "B": [-7, 20], "A": [30, 0] }},
                "input": {{ "slide": "A", "at": 27, "velocity": {velocity}, "acceleration": {acceleration} }},
                "find": ["v(B)", "a(B)"]
            }}"#
        ));
        let wish = drawing::Wish { kind: drawing::Kind::Question, ..drawing::Wish::default() };
        let figure = drawing::figure(&scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(&scene)));
        let given = within(&figure.root).into_iter().flat_map(texts).filter(|text| text.class == "given");
        given.map(|text| characters(text) + " ").collect::<String>().replace('\u{a0}', " ")
    };
    let back = told("-20", "-15");
    assert!(back.contains("V_A = 20 cm/s, A_A = 15 cm/s² in the sense of V_A"), "{back}");
    let slower = told("-20", "15");
    assert!(slower.contains("V_A = 20 cm/s, A_A = 15 cm/s² against V_A"), "{slower}");
    let steady = told("20", "0");
    assert!(steady.contains("V_A = 20 cm/s (constant)") && !steady.contains("A_A ="), "{steady}");
}

/// A crank is square to the rack that it carries: the rack does not turn, and what is zero but for its roundings is told as
/// zero. ω4 = V_A / O4A = 5 · 40 / 40 rad/s, against the crank.
#[test]
fn a_rack_that_does_not_turn_has_no_digits_of_rounding() {
    let scene = common::read(
        r#"{
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [150, 0] },
            "links": {
                "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "R"] },
                "4": { "joins": ["O4", "Q"], "length": 30 }
            },
            "placed": { "A": [0, 40], "R": [250, 40], "Q": [150, 30] },
            "rolls": [{
                "links": [4, 3], "line": { "link": 3, "through": "A", "toward": "R" }, "centre": "O4",
                "radius": 40
            }],
            "input": { "link": 2, "angle": 90, "omega": "5 rad/s ccw" }, "find": ["omega(4)", "alpha(4)", "omega(3)"]
        }"#,
    );
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
    let lines = sentences(&figure);
    let noise: Vec<&String> =
        lines.iter().filter(|line| line.contains("10^−") || line.contains("× 10−")).collect();
    assert!(noise.is_empty(), "{noise:#?}");
    let rate = lines.iter().find(|line| line.starts_with("ω_3\u{a0}= ")).unwrap();
    assert!(rate.ends_with("= 0\u{a0}rad/s"), "{rate}");
}

/// Which of three links holds a rubbing pin decides what rubs on it, and with that every force: it is given with the pin.
#[test]
fn the_link_that_holds_a_rubbing_pin_is_given() {
    let scene = common::read(
        r#"{
            "units": { "length": "mm" }, "fixed": { "O2": [-180, 40], "O4": [0, 160] },
            "links": {
                "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 150 },
                "4": { "joins": ["O4", "B"], "length": 130 }, "5": { "joins": ["B", "C"], "length": 140 }
            },
            "slides": [{ "pin": "C", "block": 6, "on": { "link": 1, "through": "O4", "angle": -90 } }],
            "near": { "B": [-25, 32], "C": [0, -108] },
            "input": { "link": 2, "angle": 20, "omega": "2 rad/s ccw" },
            "pins": {
                "B": { "carrier": 4, "radius": 20, "f": 0.1 }, "O2": { "radius": 20, "f": 0.1 }
            },
            "loads": [{ "name": "P", "on": 6, "force": "20 kN", "direction": 90 }], "find": ["T(2)"]
        }"#,
    );
    for kind in [drawing::Kind::Question, drawing::Kind::Solution] {
        let wish = drawing::Wish { kind, ..drawing::Wish::default() };
        let figure = drawing::figure(&scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(&scene)));
        let given = within(&figure.root).into_iter().flat_map(texts).filter(|text| text.class == "given");
        let given = given.map(|text| characters(text) + " ").collect::<String>().replace('\u{a0}', " ");
        assert!(given.contains("the pin at B is fixed in link 4"), "{given}");
        // A pin of two links may be either's.
        assert!(!given.contains("the pin at O"), "{given}");
    }
}

/// Weights in pounds on a four-bar linkage, with its radii of gyration.
const POUNDS: &str = r#"{
    "title": "Weights in pounds",
    "units": { "length": "in", "force": "lbf", "torque": "lbf*in", "mass": "lb" },
    "fixed": { "O2": [0, 0], "O4": [14, 2] },
    "links": {
        "2": { "joins": ["O2", "A"], "length": 4 }, "3": { "joins": ["A", "B"], "length": 13 },
        "4": { "joins": ["O4", "B"], "length": 7 }
    },
    "near": { "B": [12, 9] },
    "input": { "link": 2, "angle": 55, "omega": "300 rpm cw" },
    "gravity": {},
    "masses": {
        "3": { "weight": 6, "at": [6, 0], "gyration": 3.5 }, "4": { "weight": 9, "at": [2, 1], "gyration": 3 }
    },
    "find": ["F(1,4)", "T(2)"]
}"#;

/// A weight in pounds is reckoned as W/g: no mass in pounds, which nobody gave, comes in between.
#[test]
fn a_weight_in_pounds_is_divided_by_g() {
    let pounds = common::read(POUNDS);
    let solved = linkgram::solve::solve(&pounds, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let own = sheet::solution(&pounds, &solved.solution.construction, Language::English);
    let lines = sentences(&own).join("\n").replace('\u{a0}', " ");
    assert!(lines.contains("W_4 / g"), "{lines}");
    assert!(!lines.contains(" lb\n"), "{lines}");
}

/// A prime at an image is that of an acceleration: no point of a scene is called by one, and every contact has its letter.
#[test]
fn no_contact_is_called_by_a_prime() {
    let scene = common::example("forces/planetary-gear");
    let names: Vec<&str> = scene.mechanism.points.iter().map(|point| point.name.as_str()).collect();
    assert!(names.contains(&"P") && names.contains(&"Q"), "{names:?}");
    // A point p has the image of a contact P; a scene that has points P2 and P3 of both bodies there means the contact.
    let wheel = |name: &str| {
        format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O3": [3, 0] }}, "links": {{ "2": {{ "joins": ["O2", "{name}"], "length": 1 }},
                "3": {{ "joins": ["O3"] }} }}, "rolls": [ {{ "links": [2, 3], "centres": ["O2", "O3"], "radii": [1, 2] }} ],
                "input": {{ "link": 2, "angle": 30, "omega": 2 }}, "find": ["omega(3)"] }}"#
        )
    };
    for (name, contact) in [("A", "P"), ("P", "Q"), ("p", "Q"), ("P2", "P")] {
        let scene = common::read(&wheel(name));
        let contact_of = scene.mechanism.contacts[0];
        assert_eq!(scene.mechanism.points[contact_of.0].name, contact);
        assert!(scene.mechanism.points.iter().all(|point| !point.name.contains('′')));
    }
}

/// A line that tells a number in a second unit divides the number that stands there: 488 in/s² are 40.7 ft/s².
#[test]
fn a_second_unit_is_that_of_the_printed_number() {
    let mut lines = 0;
    for name in ["errata/s002-3", "errata/s002-4"] {
        let scene = common::example(name);
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
        for line in sentences(&figure) {
            let parts: Vec<&str> = line.split('=').map(str::trim).collect();
            for pair in parts.windows(2) {
                let (Some((inches, ..)), Some((feet, half, _))) = (number(pair[0]), number(pair[1])) else {
                    continue;
                };
                if !pair[0].contains("in/s") || !pair[1].contains("ft/s") {
                    continue;
                }
                lines += 1;
                assert!((inches / 12.0 - feet).abs() <= half * (1.0 + 1e-9), "{name}: {line}");
            }
        }
    }
    assert!(lines > 5, "{lines}");
}

/// A crank that is stated at 200° is laid off at 200°.
#[test]
fn a_stated_angle_is_laid_off_as_it_is_stated() {
    let scene = common::read(
        r#"{ "fixed": { "O2": [0, 0], "O4": [4, 0] }, "links": { "2": { "joins": ["O2", "A"], "length": 1 },
            "3": { "joins": ["A", "B"], "length": 4 }, "4": { "joins": ["O4", "B"], "length": 3 } },
            "near": { "B": [2, 2] }, "input": { "link": 2, "angle": 200, "omega": 2 }, "find": ["omega(3)"] }"#,
    );
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
    let lines = sentences(&figure);
    assert!(lines.iter().any(|line| line.contains("at 200°")), "{lines:#?}");
    assert!(lines.iter().all(|line| !line.contains("160°")), "{lines:#?}");
}

/// A construction on the skeleton takes what the paper has: at half the scale nothing of this one is told apart.
#[test]
fn an_inflection_circle_fills_the_paper() {
    let scene = common::example("constructions/inflection");
    let wish = linkgram::drawing::Wish { figures: vec!["inflection(3)".to_owned()], ..Default::default() };
    let figure =
        linkgram::drawing::figure(&scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(&scene)));
    let mut captions = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            captions.push(text.content().replace('\u{a0}', " "));
        }
    });
    assert!(captions.iter().any(|text| text.contains("1 : 2.5")), "{captions:?}");
}

/// Two lengths of which one is said to be less than the other are told with as many digits as it takes to see that.
#[test]
fn lengths_that_differ_are_told_to_differ() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [4, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 3 }, "3": { "joins": ["A", "B"], "length": 3.9999999 },
                   "4": { "joins": ["O4", "B"], "length": 1 } },
        "near": { "B": [3, 0] }, "input": { "link": 2, "angle": 90 }, "find": ["x(B)"] }"#;
    let scene = linkgram::scene::read(text, "apart.json").unwrap();
    let error =
        linkgram::solve::solve(&scene, linkgram::plan::Extent::Asked, linkgram::sheet::scale::for_scene);
    let told = linkgram::report::diagnose(&scene, &error.unwrap_err()).to_string();
    // A stands 5 mm from O4.
    assert!(told.contains("= 4.9999999 mm is less than") && told.contains("= 5 mm"), "{told}");
}
