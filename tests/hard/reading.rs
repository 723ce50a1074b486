//! Files of strangers: each is read in a moment or refused with one message, and nothing else is opened for them.

use std::time::Duration;

use linkgram::grade::{GradeSettings, grade, read_answers};
use linkgram::{limits, scene};

use super::Clock;
use super::folder::{Folder, SLIDER};

/// Hardly optimised.
const A_MOMENT: Duration = Duration::from_secs(5);

/// What is said of answers that are refused, in a moment.
fn refused(text: &str) -> String {
    let scene = scene::read(SLIDER, "slider.json").unwrap();
    let begun = Clock::start();
    let error = read_answers(text, &scene).unwrap_err().to_string();
    assert!(begun.elapsed() < A_MOMENT, "{error} after {:?}", begun.elapsed());
    error
}

fn page(inside: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 99 99">{inside}</svg>"#)
}

#[test]
fn drawings_beyond_every_measure_are_refused_in_a_moment() {
    let nested = page(&("<g>".repeat(30_000) + &"</g>".repeat(30_000)));
    assert!(refused(&nested).contains("more than 256 elements inside one another"));
    let attributes: String = (0..100_000).map(|n| format!(" a{n}=''")).collect();
    assert!(refused(&page(&format!("<g{attributes}/>"))).contains("more than 256 attributes"));
    let namespaces: String = (0..300).map(|n| format!("<g xmlns:a{n}='u{n}'/>")).collect();
    assert!(refused(&page(&namespaces)).contains("more than 256 declarations of namespaces"));
    assert!(refused(&page(&"<g/>".repeat(limits::ELEMENTS))).contains("more than 100,000 elements"));
    let path = format!("<path d='M0 0{}'/>", " 1 1".repeat(limits::MARKS));
    assert!(refused(&page(&path)).contains("more than 200,000 dots"));
    let text = "<text>a</text>".repeat(limits::LETTERS + 1);
    assert!(refused(&page(&text)).contains("more than 1,000 letters"));
    // An arc of any size is one line from here to there, never a million small ones.
    let arc = page("<path d='M0 0A1e308 1e308 0 0 1 1 1'/><text>Given</text>");
    assert!(refused(&arc).contains("no letter of this drawing"));
}

/// Letters × marks: as many as are taken, and an answer in a moment.
#[test]
fn a_letter_is_not_held_against_every_mark() {
    let scene = scene::read(SLIDER, "slider.json").unwrap();
    let marks: String = (0..150_000).map(|n| format!("M{} {}", n % 400, n / 400)).collect();
    // Each beside a dot of its own, clear of the others.
    let letters = (0..900).map(|n| (40 * (n % 30), 1000 + 40 * (n / 30), n));
    let letters: String = letters
        .map(|(x, y, n)| {
            format!("<circle cx='{}' cy='{}' r='1'/><text x='{x}' y='{y}'>a{n}</text>", x + 8, y - 6)
        })
        .collect();
    let begun = Clock::start();
    let read = read_answers(&page(&format!("<path d='{marks}'/>{letters}")), &scene).unwrap();
    assert!(begun.elapsed() < A_MOMENT, "{:?}", begun.elapsed());
    assert_eq!(read.figures[0].points.len(), 900);
}

#[test]
fn tables_and_objects_beyond_every_measure_are_refused_in_a_moment() {
    let rows = "quantity,value\n".to_owned() + &"v(A),1\n".repeat(400_000);
    assert!(refused(&rows).contains("more than 10,000 rows"), "{}", refused(&rows));
    assert!(refused(&format!("quantity,value\n{}", ",".repeat(1_000_000))).contains("more fields than"));
    let many: String = (0..1_001).map(|n| format!("velocity,p{n},1,1\n")).collect();
    assert!(refused(&format!("figure,point,x,y\n{many}")).contains("more than 1,000 answers"));
    let named: Vec<String> = (0..1_001).map(|n| format!("\"p{n}\": [1, 1]")).collect();
    let points = format!("{{ \"points\": {{ \"velocity\": {{ {} }} }} }}", named.join(", "));
    assert!(refused(&points).contains("more than 1,000 answers"));
    let lists = format!("{{ \"values\": [{}[]] }}", format!("[{}0],", "0,".repeat(9_998)).repeat(60));
    assert!(refused(&lists).contains("more than 500,000 values"), "{}", refused(&lists));
}

/// Every number that is taken leads to numbers, on standard output as in the overlay.
#[test]
fn no_answer_is_so_large_that_nothing_can_be_said_of_it() {
    let scene = scene::read(SLIDER, "slider.json").unwrap();
    let settings = GradeSettings { draughtsmen: 4, ..GradeSettings::default() };
    for number in ["1e308", "-1e308", "1e300", "1e150", "1e61", "1e59", "1e30", "1e-300", "5e-324", "0", "-0"]
    {
        for answers in [
            format!(r#"{{ "values": {{ "v(B)": {number} }} }}"#),
            format!(r#"{{ "values": {{ "v(B)": [{number}, {number}] }} }}"#),
            format!(r#"{{ "values": {{ "v(B)": 300, "omega(3)": {number} }} }}"#),
            format!(r#"{{ "lengths": {{ "v(B)": {number} }} }}"#),
            format!(r#"{{ "points": {{ "velocity": {{ "o": [0, 0], "a": [{number}, 1] }} }} }}"#),
            format!(r#"{{ "points": {{ "velocity": {{ "o": [{number}, 0], "a": [1, {number}] }} }} }}"#),
            format!(
                r#"{{ "points": {{ "velocity": {{ "o": [0, 0], "a": [1, 0] }} }}, "scan": {{ "velocity": {{ "pixels": [[0, 0], [{number}, 1]], "mm": [[0, 0], [1, {number}]] }} }} }}"#
            ),
            format!(r#"{{ "values": {{ "v(B)": 310 }}, "tolerance": {{ "v(B)": "{number} %" }} }}"#),
            format!(
                r#"{{ "values": {{ "v(B)": 310 }}, "scales": {{ "velocity": "{number} cm/s per cm" }} }}"#
            ),
            format!("quantity,value,unit\nv(B),{number},mm\n"),
        ] {
            let Ok(read) = read_answers(&answers, &scene) else { continue };
            let Ok(report) = grade(&scene, &read, &settings) else { continue };
            let json = report.to_json().to_string();
            assert!(!json.contains("null,\"unit\""), "{answers}: {json}");
            let said = report.to_text().to_lowercase();
            let words: Vec<&str> = said.split(|c: char| !c.is_alphanumeric()).collect();
            assert!(!words.contains(&"nan") && !words.contains(&"inf"), "{answers}: {said}");
        }
    }
}

/// Illustrator writes the addresses of its namespaces into the document type.
#[test]
fn a_drawing_with_a_document_type_is_read() {
    let scene = scene::read(SLIDER, "slider.json").unwrap();
    let drawing = r#"<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [
  <!ENTITY ns_extend "http://ns.adobe.com/Extensibility/1.0/">
  <!ENTITY ns_svg "http://www.w3.org/2000/svg">
]>
<svg xmlns:x="&ns_extend;" xmlns="&ns_svg;" width="99px" height="99px" viewBox="0 0 99 99">
  <circle cx="10" cy="10" r="1"/><text x="11" y="11" font-size="4">A</text>
</svg>"#;
    let read = read_answers(drawing, &scene).unwrap();
    assert_eq!(read.figures[0].points[0].0, "A");
    // What could grow, or lead elsewhere, is refused with its mend.
    for declared in
        [r#"<!ENTITY a "xx"><!ENTITY b "&a;&a;">"#, r#"<!ENTITY % p "x">"#, "<!ENTITY a \"<g/>\">"]
    {
        let text = format!("<!DOCTYPE svg [ {declared} ]><svg/>");
        let said = refused(&text);
        assert!(said.contains("more than plain texts") && said.contains("without a DOCTYPE"), "{said}");
    }
    let outside =
        refused(r#"<!DOCTYPE svg [ <!ENTITY a SYSTEM "file:///etc/passwd"> ]><svg><text>&a;</text></svg>"#);
    assert!(!outside.contains("root"), "{outside}");
}

/// A drawing lies beside its answers, or somebody says on the command line where it is.
#[test]
fn a_drawing_of_elsewhere_is_not_opened() {
    let folder = Folder::new("drawing");
    std::fs::create_dir_all(folder.path("mine")).unwrap();
    std::fs::create_dir_all(folder.path("neighbour")).unwrap();
    folder.write("slider.json", SLIDER);
    let svg = page("<circle cx='10' cy='10' r='1'/><text x='11' y='11' font-size='4'>A</text>");
    folder.write("neighbour/d.svg", &svg);
    folder.write("mine/d.svg", &svg);
    let absolute = folder.path("neighbour/d.svg");
    let mut elsewhere =
        vec!["../neighbour/d.svg".to_owned(), absolute.to_str().unwrap().to_owned(), String::new()];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../neighbour/d.svg", folder.path("mine/linked.svg")).unwrap();
        std::os::unix::fs::symlink("../neighbour", folder.path("mine/there")).unwrap();
        elsewhere.extend(["linked.svg".to_owned(), "there/d.svg".to_owned()]);
    }
    for drawing in &elsewhere {
        folder.write("mine/a.json", serde_json::json!({ "drawing": drawing }).to_string());
        let said = folder.refused(&["grade", "slider.json", "mine/a.json"]);
        assert!(said.contains("mine/a.json:1:12: drawing:") && said.contains("--drawing FILE"), "{said}");
    }
    // `-` is a name, not standard input.
    folder.write("a.json", r#"{ "drawing": "-" }"#);
    assert!(folder.refused(&["grade", "slider.json", "a.json"]).contains("No such file"));
    // Beside the answers, or wherever the teacher says.
    folder.write("mine/a.json", r#"{ "values": { "v(A)": 300 }, "drawing": "./d.svg" }"#);
    let read = |arguments: &[&str]| {
        let ran = folder.run(arguments);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.err.contains("no fixed point of the skeleton is given"), "{}", ran.err);
    };
    read(&["grade", "slider.json", "mine/a.json"]);
    folder.write("mine/a.json", r#"{ "values": { "v(A)": 300 } }"#);
    read(&["grade", "slider.json", "mine/a.json", "--drawing", "neighbour/d.svg"]);
    // Who names a drawing and no answers hands in the drawing.
    read(&["grade", "slider.json", "--drawing", "neighbour/d.svg"]);
    assert!(folder.refused(&["grade", "slider.json", "--drawing", "none.svg"]).contains("none.svg"));
}

/// What is no file is refused at once: nobody waits for a pipe or a terminal device.
#[cfg(unix)]
#[test]
fn pipes_devices_and_loops_are_never_waited_for() {
    let folder = Folder::new("pipes");
    folder.write("slider.json", SLIDER);
    folder.write("a.json", r#"{ "values": { "v(A)": 300 } }"#);
    assert!(std::process::Command::new("mkfifo").arg(folder.path("pipe.json")).status().unwrap().success());
    std::os::unix::fs::symlink("b.json", folder.path("loop.json")).unwrap();
    std::os::unix::fs::symlink("loop.json", folder.path("b.json")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.path("zero.json")).unwrap();
    let _socket = std::os::unix::net::UnixListener::bind(folder.path("socket.json")).unwrap();
    for file in ["pipe.json", "zero.json", "socket.json", "/dev/zero", "loop.json", "."] {
        for command in [&["solve", file][..], &["grade", "slider.json", file], &["grade", file, "a.json"]] {
            let said = folder.refused(command);
            assert!(said.contains(file), "{said}");
        }
        let drawing = folder.refused(&["grade", "slider.json", "a.json", "--drawing", file]);
        assert!(drawing.contains(file), "{drawing}");
    }
    assert!(folder.refused(&["grade", "-", "-"]).contains("both be standard input"));
    // A folder with all of them in it: the scene is checked, the others are told.
    std::fs::remove_file(folder.path("a.json")).unwrap();
    let ran = folder.run(&["check", "."]);
    assert_eq!(ran.code, Some(2), "{}", ran.err);
    assert!(ran.out.contains("1 of 6 scenes hold"), "{}", ran.out);
    assert!(ran.err.contains("pipe.json: is a pipe"), "{}", ran.err);
    // Folders that hold one another by two names each: 2⁶⁰ ways through them.
    std::fs::create_dir_all(folder.path("maze")).unwrap();
    for n in 0..60 {
        let path = folder.path(&format!("maze/{n}"));
        std::fs::create_dir(&path).unwrap();
        for name in ["a", "b"] {
            std::os::unix::fs::symlink(format!("../{}", n + 1), path.join(name)).unwrap();
        }
    }
    std::fs::create_dir(folder.path("maze/60")).unwrap();
    assert!(folder.refused(&["check", "maze"]).contains("no .json file in this folder"));
}

/// What a terminal obeys stands in titles, names of files, keys and answers; none of it arrives there.
#[cfg(unix)]
#[test]
fn nothing_of_a_file_commands_the_terminal() {
    let folder = Folder::new("terminal");
    let evil = "\u{1b}]0;owned\u{7}\u{9b}31m\u{202e}";
    let file = format!("{evil}.json");
    let titled = SLIDER.replacen('{', &format!("{{ \"title\": {},", serde_json::json!(evil)), 1);
    folder.write("titled.json", &titled);
    folder.write(&file, "{ \"a\": }");
    folder.write("key.json", serde_json::json!({ evil: 1, "links": evil }).to_string());
    folder.write("answers.json", serde_json::json!({ "student": evil, "values": { "v(A)": 1 } }).to_string());
    folder.write("unknown.json", serde_json::json!({ "values": { evil: 1 } }).to_string());
    folder.write("unknown.csv", format!("quantity,value\n{evil},1\n"));
    std::fs::create_dir(folder.path("suite")).unwrap();
    folder.write("suite/titled.json", &titled);
    folder.write(&format!("suite/{file}"), "{}");
    folder.write("suite/suite.json", serde_json::json!({ "figures": [{ "scenes": [evil] }] }).to_string());
    for command in [
        &["check", "."][..],
        &["check", ".", "--json"],
        &["solve", &file],
        &["solve", "titled.json"],
        &["solve", "titled.json", "--json"],
        &["solve", "key.json"],
        &["solve", &format!("{evil}none.json")],
        &["solve", "titled.json", &format!("--{evil}")],
        &["structure", "titled.json"],
        &["sweep", "titled.json"],
        &["draw", "titled.json", "-o", &format!("{evil}.none")],
        &["draw", "titled.json", "-o", &format!("{evil}/x.svg")],
        &["grade", "titled.json", "answers.json"],
        &["grade", "titled.json", "answers.json", "--json"],
        &["grade", "titled.json", "unknown.json"],
        &["grade", "titled.json", "unknown.csv"],
        &["golden", "check", "suite"],
        &["golden", "check", "suite", evil],
        &["golden", "check", "suite", "--json"],
        &["exam", "titled.json", "--variants", "1", "-o", evil],
    ] {
        let ran = folder.run(command);
        assert!(ran.code.is_some_and(|code| code <= 2), "{command:?}: {ran:?}");
        for told in [&ran.out, &ran.err] {
            let obeyed = |c: char| c != '\n' && c.is_control() || c == '\u{202e}';
            assert!(!told.contains(obeyed), "{command:?}: {told:?}");
        }
    }
}

/// What is asked for by name, loads and springs have an end that is told at once: what is computed for each of them goes
/// through everything.
#[test]
fn lists_that_cost_for_each_entry_have_an_end() {
    let scene: serde_json::Value = serde_json::from_str(SLIDER).unwrap();
    let with = |key: &str, list: Vec<serde_json::Value>| {
        let mut scene = scene.clone();
        scene[key] = list.into();
        scene::read(&scene.to_string(), "long.json").map(|_| ()).map_err(|error| error.to_string())
    };
    let names = |count: usize| vec![serde_json::json!("v(B)"); count];
    assert_eq!(with("find", names(limits::ASKED)), Ok(()));
    let told = with("find", names(limits::ASKED + 1)).unwrap_err();
    assert!(told.contains("find: 1,001 entries, more than 1,000"), "{told}");
    let load = |k: usize| serde_json::json!({"name": format!("L{k}"), "on": 3, "at": "B", "force": 5, "direction": k});
    let told = with("loads", (0..=limits::ASKED).map(load).collect()).unwrap_err();
    assert!(told.contains("loads: 1,001 entries, more than 1,000"), "{told}");
    let spring = |k: usize| serde_json::json!({"name": format!("S{k}"), "links": [1, 3], "stiffness": 1});
    let told = with("springs", (0..=limits::ASKED).map(spring).collect()).unwrap_err();
    assert!(told.contains("springs: 1,001 entries, more than 1,000"), "{told}");
}

/// Where there is nothing that could be left out a sheet is refused by the same drawing as the numbers, and not by two more
/// of another size: by how much the chain fails to close is told alike.
#[test]
fn a_sheet_is_refused_as_the_numbers_are() {
    let yoke = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]},
        "links": {"2": {"joins": ["C", "A"], "length": 50}, "4": {"joins": ["C"]}},
        "slides": [{"link": 4, "on": {"link": 1, "through": [0, -30], "angle": 0}},
                   {"pin": "A", "block": 3, "on": {"link": 4, "through": "C", "angle": 65}}],
        "input": {"link": 2, "angle": 40, "omega": "10 rad/s ccw"}}"#;
    let scene = scene::read(yoke, "yoke.json").unwrap();
    let numbers = linkgram::solve::solve_numbers(&scene, linkgram::solve::Settings::default()).unwrap_err();
    let sheet = linkgram::solve::solve(
        &scene,
        linkgram::plan::Extent::WholeSkeleton,
        linkgram::sheet::scale::for_scene,
    );
    assert_eq!(sheet.unwrap_err(), numbers);
}
