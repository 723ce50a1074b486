//! Names of a scene inside question banks: they are text there, whatever they look like.

use roxmltree::Document;

use super::folder::Folder;
use crate::common;

/// Moodle looks for `{1:NUMERICAL:=5}` in the text of a question before it reads it as hypertext.
fn fields(question: &str) -> usize {
    let kinds = ["NUMERICAL", "NM", "SHORTANSWER", "SA", "MW", "MULTICHOICE", "MC", "MULTIRESPONSE", "MR"];
    question
        .match_indices('{')
        .filter(|(at, _)| {
            let rest = question[at + 1..].trim_start_matches(|c: char| c.is_ascii_digit());
            kinds.iter().any(|kind| rest.strip_prefix(':').is_some_and(|r| r.starts_with(kind)))
        })
        .count()
}

#[test]
fn a_name_is_no_field_and_no_markup() {
    let scene = common::example_text("exam/crank-and-slider");
    let plain: serde_json::Value = serde_json::from_str(&scene).unwrap();
    for name in ["B{1:NUMERICAL:=5}", "B{:NM:=5~=6}", "B]]><b>", "B\u{fffe}\u{ffff}", "B&amp;<script>", "B@@"]
    {
        let folder = Folder::new("banks");
        // `@`, blanks and quotes are in no name; whatever a scene takes, a bank must take.
        let text = renamed(&plain, name);
        folder.write("scene.json", text.to_string());
        let ran = folder.run(&["exam", "scene.json", "-o", "exam", "--variants", "2", "--lang", "en,fa"]);
        if ran.code == Some(2) {
            assert!(ran.err.contains("cannot name a point"), "{}", ran.err);
            continue;
        }
        assert_eq!(ran.code, Some(0), "{name}: {}", ran.err);
        let key = std::fs::read_to_string(folder.path("exam/key.csv")).unwrap();
        let answers = key.lines().count() - 1;
        for language in ["en", "fa"] {
            let read = |file: &str| std::fs::read_to_string(folder.path("exam").join(file)).unwrap();
            let cloze = read(&format!("moodle-cloze.{language}.xml"));
            let document = Document::parse(&cloze).unwrap_or_else(|error| panic!("{name}: {error}"));
            let questions = document.descendants().filter(|n| n.has_tag_name("questiontext"));
            let texts = questions.flat_map(|q| q.children()).filter(|n| n.has_tag_name("text"));
            let found: usize = texts.filter_map(|n| n.text()).map(fields).sum();
            assert_eq!(found, answers, "{name}: a name is a field");
            let numerical = read(&format!("moodle-numerical.{language}.01.xml"));
            Document::parse(&numerical).unwrap_or_else(|error| panic!("{name}: {error}"));
            packaged(&folder, language, name);
        }
    }
}

/// Every file of the package is XML.
fn packaged(folder: &Folder, language: &str, name: &str) {
    let bytes = std::fs::read(folder.path(&format!("exam/qti.{language}.zip"))).unwrap();
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
    for index in 0..zip.len() {
        let mut file = zip.by_index(index).unwrap();
        let mut text = String::new();
        std::io::Read::read_to_string(&mut file, &mut text).unwrap();
        let what = Document::parse(&text).err();
        assert!(what.is_none(), "{name}: file {index}: {what:?}");
        assert!(!text.contains(['\u{fffe}', '\u{ffff}']), "{name}");
    }
}

/// The scene with another name for its point B, and that name in its title.
fn renamed(value: &serde_json::Value, name: &str) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::String(text) if text == "B" => Value::String(name.to_owned()),
        Value::String(text) => {
            let open =
                [("(B)", format!("({name})")), ("(B/", format!("({name}/")), ("/B)", format!("/{name})"))];
            let renamed = open.iter().fold(text.clone(), |text, (old, new)| text.replace(old, new));
            Value::String(renamed)
        }
        Value::Array(list) => list.iter().map(|inner| renamed(inner, name)).collect(),
        Value::Object(map) => {
            let pairs = map.iter().map(|(key, inner)| {
                let key = if key == "B" { name.to_owned() } else { key.clone() };
                (key, renamed(inner, name))
            });
            let mut object: serde_json::Map<String, Value> = pairs.collect();
            if object.contains_key("title") {
                object.insert("title".to_owned(), Value::String(format!("Crank {name}")));
            }
            Value::Object(object)
        }
        other => other.clone(),
    }
}
