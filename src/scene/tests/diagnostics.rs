use super::{bad, example_with, good};

/// Part of the example that is replaced, its replacement, the path, and words of the message.
type Case = (&'static str, &'static str, &'static str, &'static [&'static str]);

const CASES: &[Case] = &[
    // Keys and kinds.
    ("\"near\"", "\"naer\"", "naer", &["unknown key", "`near`"]),
    (
        "\"length\": 45",
        "\"lenght\": 45",
        "links.3.lenght",
        &["unknown key `lenght`", "did you mean `length`"],
    ),
    ("\"radius\"", "\"raduis\"", "pins.B.raduis", &["`radius`"]),
    ("\"length\": 15", "\"length\": null", "links.2.length", &["a length", "null"]),
    ("\"length\": 15", "\"length\": [15]", "links.2.length", &["found a list"]),
    ("[\"A\", \"B\"]", "\"AB\"", "links.3.joins", &["a list of points", "text"]),
    ("{ \"B\": [52, -14], \"D\": [1, 37] }", "[]", "near", &["places of moving points", "a list"]),
    ("\"length\": 15", "\"length\": 15, \"length\": 16", "links.2.length", &["given twice"]),
    // Numbers and units.
    ("\"length\": 15", "\"length\": 1e400", "links.2.length", &["1e400", "range"]),
    ("\"length\": 15", "\"length\": 1e-400", "links.2.length", &["range"]),
    ("\"length\": 15", "\"length\": 1e90", "links.2.length", &["range"]),
    ("\"length\": 15", "\"length\": 0", "links.2.length", &["greater than zero"]),
    ("\"length\": 15", "\"length\": -15", "links.2.length", &["greater than zero"]),
    ("\"length\": 15", "\"length\": \"15 deg\"", "links.2.length", &["an angle", "a length", "`cm`"]),
    ("\"length\": 15", "\"length\": \"15 cmm\"", "links.2.length", &["`cmm` is not a unit", "`cm`"]),
    ("\"length\": 15", "\"length\": \"15 cm cw\"", "links.2.length", &["no sense of rotation"]),
    ("\"length\": 15", "\"length\": \"about 15\"", "links.2.length", &["begin with a number", "\"6 cm\""]),
    ("\"length\": 15", "\"length\": \"nan\"", "links.2.length", &["begin with a number"]),
    (
        "\"angle\": 30",
        "\"angle\": \"30 cm\"",
        "input.angle",
        &["`cm` measures a length", "an angle is expected"],
    ),
    ("10 rad/s cw", "10 1/s cw", "input.omega", &["is not a unit"]),
    ("10 rad/s cw", "10 rad cw", "input.omega", &["an angle", "an angular velocity", "`rad/s`"]),
    ("10 rad/s cw", "10 rad/s^x cw", "input.omega", &["exponent"]),
    ("10 rad/s cw", "10 rad/s clockwise", "input.omega", &["write `cw`"]),
    ("10 rad/s cw", "10 rad/s CCW", "input.omega", &["write `ccw`"]),
    ("10 rad/s cw", "300 U/min cw", "input.omega", &["write `rpm`"]),
    ("10 rad/s cw", "10 rad/ cw", "input.omega", &["`rad/` is not a unit"]),
    ("10 rad/s cw", "10 nm^9*nm^9 cw", "input.omega", &["not a unit"]),
    ("\"length\": \"cm\"", "\"length\": \"cms\"", "units.length", &["`cms`", "`cm`"]),
    ("\"angle\": \"deg\"", "\"angle\": \"degrees\"", "units.angle", &["unit of angle", "`deg`"]),
    ("\"time\": \"s\"", "\"time\": \"cm\"", "units.time", &["unit of time"]),
    ("[45, 15]", "[45, 15, 0]", "fixed.O4", &["[x, y]", "3"]),
    // What variants change.
    (
        "\"near\":",
        "\"vary\": { \"links.2.lenght\": { \"from\": 1, \"to\": 2, \"step\": 1 } }, \"near\":",
        "vary.links.2.lenght",
        &["not a given number", "did you mean `links.2.length`"],
    ),
    (
        "\"near\":",
        "\"vary\": { \"near.B[0]\": { \"from\": 1, \"to\": 2, \"step\": 1 } }, \"near\":",
        "vary.near.B[0]",
        &["not a given number"],
    ),
    (
        "\"near\":",
        "\"vary\": { \"slides[0].block\": { \"from\": 1, \"to\": 2, \"step\": 1 } }, \"near\":",
        "vary.slides[0].block",
        &["not a given number"],
    ),
    (
        "\"near\":",
        "\"vary\": { \"input.omega\": { \"from\": 8, \"to\": 12, \"step\": 3 } }, \"near\":",
        "vary.input.omega.to",
        &["no whole number of steps", "end at 11 or at 14"],
    ),
    // Points and links.
    ("\"O4\": [45, 15]", "\"4\": [45, 15]", "fixed.4", &["cannot name a point", "begins with a letter"]),
    ("\"O4\": [45, 15]", "\"O/4\": [45, 15]", "fixed.O/4", &["cannot name a point"]),
    ("\"D\": [1, 37]", "\"E\": [1, 37]", "near.E", &["no point `E`", "known are `O2`, `O4`, `A`"]),
    ("\"D\": [1, 37]", "\"O2\": [1, 37]", "near.O2", &["fixed point"]),
    ("\"2\": {", "\"1\": {", "links.1", &["link 1 is the frame", "`fixed`"]),
    ("\"2\": {", "\"crank\": {", "links.crank", &["not the number of a link"]),
    ("\"2\": {", "\"02\": {", "links.02", &["not the number of a link"]),
    ("[\"A\", \"B\"]", "[]", "links.3.joins", &["at least one joint"]),
    ("[\"A\", \"B\"]", "[\"A\", \"A\"]", "links.3.joins[1]", &["listed twice"]),
    ("\"joins\": [\"A\", \"B\"], ", "", "links.3", &["`joins` is missing"]),
    // Dimensions.
    (
        ", \"length\": 45",
        "",
        "links.3",
        &["dimensions of link 3 are missing", "`length`", "`A`, `B`", "`placed`"],
    ),
    ("\"line\": [0, 30, -30]", "\"length\": 30", "links.4.length", &["2 points", "has 3"]),
    ("\"line\": [0, 30, -30]", "\"line\": [0, 30]", "links.4.line", &["3 positions", "found 2"]),
    ("\"line\": [0, 30, -30]", "\"line\": [3, 3, 3]", "links.4.line", &["no length"]),
    ("\"line\": [0, 30, -30]", "\"sides\": [1, 2, 30]", "links.4.sides", &["1 cm + 2 cm is less than 30 cm"]),
    ("\"line\": [0, 30, -30]", "\"sides\": [1, 3, 2]", "links.4.sides", &["only equals 3 cm", "`line`"]),
    ("\"line\": [0, 30, -30]", "\"sides\": [3, 4, 5], \"turn\": \"cww\"", "links.4.turn", &["`cww`", "`c"]),
    (
        "\"line\": [0, 30, -30]",
        "\"line\": [0, 30, -30], \"turn\": \"cw\"",
        "links.4.turn",
        &["no meaning", "`sides`"],
    ),
    ("\"line\": [0, 30, -30]", "\"arms\": [0, 3, 90]", "links.4.arms[0]", &["greater than zero"]),
    (
        "\"line\": [0, 30, -30]",
        "\"line\": [0, 30, -30], \"sides\": [3, 4, 5]",
        "links.4.sides",
        &["`line` already", "one too many"],
    ),
    (
        "\"line\": [0, 30, -30]",
        "\"shape\": { \"O4\": [0, 0], \"B\": [1, 0], \"X\": [2, 3] }",
        "links.4.shape.X",
        &["not among the points of link 4", "`O4`"],
    ),
    (
        "\"line\": [0, 30, -30]",
        "\"shape\": { \"O4\": [0, 0], \"B\": [1, 0] }",
        "links.4.shape",
        &["`C` are missing"],
    ),
    // Guides.
    ("\"pin\": \"D\"", "\"pin\": \"E\"", "slides[0].pin", &["no point `E`"]),
    ("\"pin\": \"D\", ", "", "slides[0]", &["what slides is missing"]),
    ("\"block\": 6", "\"block\": 5", "slides[0].block", &["other than D", "\"link\": 5"]),
    ("\"block\": 6", "\"block\": 1", "slides[0].block", &["cannot be link 1"]),
    ("\"block\": 6", "\"block\": \"6\"", "slides[0].block", &["whole number", "text"]),
    ("\"link\": 1, \"through\"", "\"link\": 7, \"through\"", "slides[0].on.link", &["no link 7", "`"]),
    ("\"link\": 1, \"through\"", "\"link\": 5, \"through\"", "slides[0].on", &["D stands in link 5"]),
    (
        "\"through\": [0, 37]",
        "\"through\": \"C\"",
        "slides[0].on.through",
        &["C does not stand in link 1", "O2, O4"],
    ),
    ("\"through\": [0, 37], ", "", "slides[0].on", &["`through` is missing"]),
    (", \"angle\": 0", ", \"angle\": 0, \"toward\": \"O2\"", "slides[0].on.toward", &["not both"]),
    (
        "\"through\": [0, 37], \"angle\": 0",
        "\"through\": \"O2\", \"toward\": \"O2\"",
        "slides[0].on.toward",
        &["no direction"],
    ),
    (", \"angle\": 0", ", \"centre\": \"O2\", \"radius\": 3", "slides[0].on.through", &["an arc has"]),
    ("\"pin\": \"D\", \"block\": 6", "\"link\": 5, \"block\": 6", "slides[0].block", &["no meaning"]),
    // Inputs.
    ("\"input\":  { \"link\": 2", "\"input\":  { \"link\": 22", "input.link", &["no link 22", "`2`"]),
    ("\"input\":  { \"link\": 2", "\"input\":  { \"link\": 1", "input.link", &["frame"]),
    (", \"angle\": 30", "", "input", &["`angle` is missing", "O2 to A", "`placed`"]),
    ("\"omega\"", "\"omga\"", "input.omga", &["`omega`"]),
    ("\"omega\"", "\"velocity\"", "input.velocity", &["driven `slide`"]),
    (
        "\"omega\": \"10 rad/s cw\"",
        "\"speed\": { \"B\": 3 }",
        "input.speed.B",
        &["B does not stand in link 2"],
    ),
    ("\"omega\": \"10 rad/s cw\"", "\"speed\": { \"O2\": 3 }", "input.speed.O2", &["no speed"]),
    (
        "\"link\": 2, \"angle\": 30, \"omega\": \"10 rad/s cw\"",
        "\"slide\": \"C\", \"at\": 3",
        "input.slide",
        &["nothing in `slides`", "\"D\" or 6"],
    ),
    (
        "\"link\": 2, \"angle\": 30, \"omega\": \"10 rad/s cw\"",
        "\"slide\": 6",
        "input",
        &["`at` is missing: D is not placed"],
    ),
    ("\"input\":  { \"link\": 2,", "\"input\":  { \"link\": 2, \"slide\": 6,", "input.slide", &["not both"]),
    (
        "{ \"link\": 2, \"angle\": 30, \"omega\": \"10 rad/s cw\" }",
        "[{ \"link\": 2 }]",
        "input",
        &["one input", "`inputs`"],
    ),
    // Names.
    ("\"v(B/A)\"", "\"v(E/A)\"", "find[1]", &["`v(E/A)`", "no point `E`", "`A`"]),
    ("\"v(B/A)\"", "\"v(B/B)\"", "find[1]", &["are one"]),
    ("\"v(B/A)\"", "\"velocity(B)\"", "find[1]", &["not the name of a quantity"]),
    ("\"v(B/A)\"", "\"omga(3)\"", "find[1]", &["`omega`"]),
    ("\"v(B/A)\"", "\"v B\"", "find[1]", &["not the name of a quantity"]),
    ("\"v(B/A)\"", "\"v(3)\"", "find[1]", &["no point `3`", "write v(B)"]),
    ("\"v(B/A)\"", "\"omega(B)\"", "find[1]", &["no link `B`", "omega(3)"]),
    ("\"v(B/A)\"", "\"omega(9)\"", "find[1]", &["no link `9`"]),
    ("\"v(B/A)\"", "\"an(D/A)\"", "find[1]", &["do not stand in one link", "`C`"]),
    ("\"v(B/A)\"", "\"an(D)\"", "find[1]", &["no link that is pivoted"]),
    ("\"v(B/A)\"", "\"an(O4)\"", "find[1]", &["fixed point"]),
    ("\"v(B/A)\"", "\"slip(B/1)\"", "find[1]", &["B does not slide on link 1", "what slides: D"]),
    ("\"v(B/A)\"", "\"slip(D/4)\"", "find[1]", &["it slides on link 1"]),
    ("\"v(B/A)\"", "\"aslipn(D/1)\"", "find[1]", &["straight", "aslip(D/1)"]),
    ("\"v(B/A)\"", "\"I(3,3)\"", "find[1]", &["are one"]),
    ("\"v(B/A)\"", "\"I(13)\"", "find[1]", &["write I(1,3)"]),
    ("\"v(B/A)\"", "\"rub(C)\"", "find[1]", &["radius of pin C is missing", "\"pins\""]),
    ("\"v(B/A)\"", "\"rub(B,3/5)\"", "find[1]", &["B does not stand in link 5"]),
    ("\"v(B/A)\"", "\"transmission(3/5)\"", "find[1]", &["no pin in common"]),
    (
        "\"v(B/A)\"",
        "{ \"name\": \"v(B)\", \"unit\": \"rad/s\" }",
        "find[1].unit",
        &["an angular velocity", "a velocity"],
    ),
    ("\"v(B/A)\"", "{ \"unit\": \"cm/s\" }", "find[1]", &["`name` is missing"]),
    ("\"v(B/A)\"", "7", "find[1]", &["name of a quantity", "a number"]),
    // Pins, published, the rest.
    ("\"radius\": \"5 mm\"", "\"radius\": 5, \"diameter\": 10", "pins.B.diameter", &["not both"]),
    ("\"radius\": \"5 mm\"", "", "pins.B", &["`radius` or `diameter`"]),
    ("\"pins\":   { \"B\"", "\"pins\":   { \"BB\"", "pins.BB", &["no point `BB`", "`B`"]),
    ("\"170 cm/s\"", "\"170 cm\"", "published.v(B)", &["a length", "a velocity"]),
    ("\"170 cm/s\"", "\"170 cm/s cw\"", "published.v(B)", &["no sense"]),
    ("\"alpha(5)\"", "\"alpha(55)\"", "published.alpha(55)", &["no link `55`"]),
    ("\"10 %\"", "\"10 cm\"", "published.alpha(5).within", &["\"10 %\""]),
    ("\"10 %\"", "10", "published.alpha(5).within", &["at most 100 %", "\"10 %\""]),
    ("\"near\":", "\"errata\": [\"v(C)\"], \"near\":", "errata[0]", &["not in `published`", "`v(B)`"]),
    ("\"near\":", "\"expect\": \"ambigous\", \"near\":", "expect", &["`ambiguous`"]),
    ("\"near\":", "\"inputs\": [], \"near\":", "input", &["`inputs`"]),
    ("\"near\":", "\"sheet\": { \"paper\": \"A44\" }, \"near\":", "sheet.paper", &["`A4`"]),
    ("\"near\":", "\"sheet\": { \"language\": \"de\" }, \"near\":", "sheet.language", &["`de`", "`en`"]),
    ("\"near\":", "\"sheet\": { \"length\": 10 }, \"near\":", "sheet.length", &["\"1:10\""]),
    (
        "\"near\":",
        "\"sheet\": { \"scales\": { \"length\": \"1:0\" } }, \"near\":",
        "sheet.scales.length",
        &["zero"],
    ),
    ("\"near\":", "\"sheet\": { \"velocity\": \"5 cm per cm\" }, \"near\":", "sheet.velocity", &["a length"]),
    // Rolling pairs.
    ("\"near\":", "\"rolls\": [{ \"links\": [2, 2] }], \"near\":", "rolls[0].links[1]", &["on itself"]),
    ("\"near\":", "\"rolls\": [{ \"links\": [2, 3] }], \"near\":", "rolls[0]", &["`centres` is missing"]),
    (
        "\"near\":",
        "\"rolls\": [{ \"links\": [2, 4], \"centres\": [\"A\", \"D\"], \"radii\": [1, 2] }], \"near\":",
        "rolls[0].centres[1]",
        &["D does not stand in link 4", "O4, B, C"],
    ),
    (
        "\"near\":",
        "\"rolls\": [{ \"links\": [2, 4], \"centres\": [\"A\", \"C\"], \"teeth\": [20, 0], \"module\": 1 }], \"near\":",
        "rolls[0].teeth[1]",
        &["0 teeth"],
    ),
    (
        "\"near\":",
        "\"rolls\": [{ \"links\": [2, 4], \"centres\": [\"A\", \"C\"], \"teeth\": [20, 30] }], \"near\":",
        "rolls[0]",
        &["`module` is missing"],
    ),
    (
        "\"near\":",
        "\"rolls\": [{ \"links\": [1, 5], \"line\": { \"link\": 2, \"through\": \"A\" }, \"centre\": \"D\", \"radius\": 1 }], \"near\":",
        "rolls[0].line",
        &["link 2", "not in `links`"],
    ),
];

/// Every kind of mistake is told where it stands, what is wrong and, where possible, how to mend it.
#[test]
fn every_mistake_has_its_place_and_its_mend() {
    let mut wrong = Vec::new();
    for (old, new, path, words) in CASES {
        let text = example_with(old, new);
        let error = bad(&text);
        let message = error.to_string();
        if error.path != *path || !words.iter().all(|word| message.contains(word)) {
            wrong.push(format!("{new}\n  expected {path}: {words:?}\n  found    {message}"));
            continue;
        }
        assert!(!message.contains('\n'), "{message}");
        // The place is where the last key of the path, or its value, stands.
        let line = text.lines().nth(error.line - 1).unwrap();
        let rest: String = line.chars().skip(error.column - 1).collect();
        assert!(
            rest.starts_with(['"', '[', '{', 'n', '-', '0', '1', '2', '3', '4', '5', '7']),
            "{message}\n{rest}"
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn one_line_whatever_a_name_contains() {
    let error = bad(&format!("{{\"a\\n{}\": 1}}", "x".repeat(1000))).to_string();
    assert!(!error.contains('\n') && error.chars().count() < 1000, "{error}");
    assert!(error.contains("a\\nxx"), "{error}");
}

#[test]
fn places_are_exact() {
    let error = bad(&example_with("\"length\": 45", "\"length\": \"45 deg\""));
    assert_eq!((error.file.as_str(), error.line, error.column), ("scene.json", 7, 43));
    let error = bad("{\n  \"links\": { \"2\": { \"joins\": [\"Ä\", \"ä\", 3] } } }");
    assert_eq!((error.line, error.column, error.path.as_str()), (2, 41, "links.2.joins[2]"));
    let error = bad(&example_with("\"length\": 45 },", "\"length\": 45 }"));
    assert_eq!((error.line, error.path.as_str()), (8, ""));
    assert!(error.what.starts_with("not JSON: expected"), "{error}");
    assert_eq!(
        bad("[]").to_string(),
        "scene.json:1:1: expected a scene: {\"links\": {…}, \"input\": {…}, …}, found a list"
    );
}

#[test]
fn one_pin_on_two_guides_needs_the_block() {
    let text = example_with(
        "\"slides\": [",
        r#""slides": [ { "pin": "D", "block": 7, "on": { "link": 4, "through": "C" } }, "#,
    );
    let drive = |slide: &str| {
        text.replace(
            "\"link\": 2, \"angle\": 30, \"omega\": \"10 rad/s cw\"",
            &format!("\"slide\": {slide}, \"at\": 3"),
        )
    };
    assert!(bad(&drive("\"D\"")).to_string().contains("two guides"));
    good(&drive("7"));
    let twice = text.replace("\"block\": 7", "\"block\": 6");
    assert!(bad(&twice).what.contains("slides in another pair"));
}

#[test]
fn a_pin_on_two_guides_that_nothing_has_is_told_so() {
    let error = bad(r#"{ "fixed": { "O2": [0, 0] }, "links": { "2": { "joins": ["O2"] } },
             "slides": [ { "pin": "D", "on": { "link": 1, "through": [0, 2], "angle": 0 } },
                         { "pin": "D", "on": { "link": 2, "through": "O2" } } ],
             "placed": { "D": [3, 2] }, "input": { "link": 2, "omega": 1 }, "find": ["v(D)"] }"#);
    assert_eq!(error.path, "slides[1].pin");
    let message = error.to_string();
    assert!(message.contains("no link and no block has it") && message.contains("\"block\": 5"), "{message}");
}

#[test]
fn a_block_does_not_invent_its_pin() {
    let error = bad(&example_with("\"pin\": \"D\"", "\"pin\": \"DD\""));
    assert_eq!(
        error.to_string(),
        "scene.json:11:24: slides[0].pin: there is no point `DD`; help: did you mean `D`?"
    );
}

#[test]
fn a_pin_of_three_links_names_two_to_rub() {
    let text = example_with("[\"C\", \"D\"], \"length\": 37", "[\"B\", \"D\"], \"length\": 37");
    let error = bad(&text);
    assert!(
        error.to_string().contains("B joins links 3, 4, 5; help: say which two, such as rub(B,3/4)"),
        "{error}"
    );
    good(&text.replace("rub(B)", "rub(B,5/3)"));
}
