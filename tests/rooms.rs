//! Doors go one way: which room of `src/` uses which other one, against the list in ARCHITECTURE.md.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::common::root;

/// A room that uses another, and one place where it does so.
type Doors = BTreeMap<(String, String), String>;

/// The code of a file: without comments, and without its own tests.
fn code_of(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// Every file of `src/` with the room that it belongs to; those of tests and of the program itself are left out.
fn sources() -> Vec<(String, PathBuf)> {
    let src = root().join("src");
    let mut found = Vec::new();
    let mut waiting = vec![src.clone()];
    while let Some(folder) = waiting.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let first = path.strip_prefix(&src).unwrap().components().next().unwrap();
            let room = first.as_os_str().to_str().unwrap().trim_end_matches(".rs").to_owned();
            let stem = path.file_stem().unwrap().to_str().unwrap();
            if stem == "tests" || ["lib", "main"].contains(&room.as_str()) {
                continue;
            }
            if path.is_dir() {
                waiting.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                found.push((room, path));
            }
        }
    }
    found.sort();
    found
}

/// The names that a path goes through, with everything in its braces: `board::{Arithmetic, Hand}` gives both.
fn paths(tree: &str) -> Vec<Vec<String>> {
    let tree = tree.trim();
    if let Some((before, inside)) = tree.split_once('{') {
        let prefix: Vec<String> =
            before.split("::").map(str::trim).filter(|s| !s.is_empty()).map(str::to_owned).collect();
        let inside = inside.strip_suffix('}').unwrap_or(inside);
        let (mut depth, mut start, mut parts) = (0_i32, 0, Vec::new());
        for (at, sign) in inside.char_indices() {
            match sign {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    parts.push(&inside[start..at]);
                    start = at + 1;
                }
                _ => {}
            }
        }
        parts.push(&inside[start..]);
        let parts = parts.into_iter().filter(|part| !part.trim().is_empty());
        return parts.flat_map(paths).map(|path| [prefix.clone(), path].concat()).collect();
    }
    let names = tree.split("::").map(|name| name.split_whitespace().next().unwrap_or("").to_owned());
    vec![names.filter(|name| !name.is_empty() && name != "self").collect()]
}

/// Every path of a code that begins with `crate::`, and whether it is exported again.
fn crate_paths(code: &str) -> Vec<(Vec<String>, bool)> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        let (mut depth, mut end) = (0_i32, rest.len());
        for (at, sign) in rest.char_indices() {
            match sign {
                '{' => depth += 1,
                '}' if depth > 0 => depth -= 1,
                _ if depth > 0 || sign.is_alphanumeric() || sign == '_' || sign == ':' => continue,
                _ => {
                    end = at;
                    break;
                }
            }
            if depth == 0 {
                end = at + 1;
                break;
            }
        }
        let line = code[..at].rsplit([';', '}', '\n']).next().unwrap();
        let exported =
            line.trim_start().starts_with("pub") && line.split_whitespace().any(|word| word == "use");
        found.extend(paths(&rest[..end]).into_iter().map(|path| (path, exported)));
    }
    found
}

/// Who uses whom. What a room exports again from another, its users have of the other.
fn doors() -> Doors {
    let sources = sources();
    let rooms: BTreeSet<&str> = sources.iter().map(|(room, _)| room.as_str()).collect();
    let mut exported: BTreeMap<(&str, String), String> = BTreeMap::new();
    let mut used = Vec::new();
    for (room, file) in &sources {
        for (path, again) in crate_paths(&code_of(file)) {
            let Some(first) = path.first().filter(|first| rooms.contains(first.as_str())) else { continue };
            if again {
                exported.insert((room.as_str(), path.last().unwrap().clone()), first.clone());
            }
            used.push((room, path, file));
        }
    }
    let mut doors = Doors::new();
    for (room, path, file) in used {
        let through = path.iter().skip(1).find_map(|name| exported.get(&(path[0].as_str(), name.clone())));
        for other in [Some(&path[0]), through].into_iter().flatten().filter(|other| *other != room) {
            let place = format!("{} uses crate::{}", file.display(), path.join("::"));
            doors.entry((room.clone(), other.clone())).or_insert(place);
        }
    }
    doors
}

/// The list: each room, those before it that it may use, and, after a bar, those that it uses against the order.
fn listed() -> Vec<(String, Vec<String>, Vec<String>)> {
    let text = std::fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let list = text.split("```rooms\n").nth(1).expect("the list of rooms").split("```").next().unwrap();
    let names = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let line = |line: &str| {
        let (ordered, against) = line.split_once('|').unwrap_or((line, ""));
        let mut ordered = names(ordered);
        (ordered.remove(0), ordered, names(against))
    };
    list.lines().filter(|text| !text.trim().is_empty()).map(line).collect()
}

#[test]
fn a_room_uses_only_the_rooms_that_are_listed_for_it() {
    let listed = listed();
    let doors = doors();
    let mut before: BTreeSet<&String> = BTreeSet::new();
    let mut open = BTreeSet::new();
    for (room, ordered, against) in &listed {
        for other in ordered {
            assert!(before.contains(other), "{room} uses {other}, which does not stand before it");
        }
        for other in against {
            assert!(!before.contains(other), "{room} uses {other} in the order: take away the bar");
        }
        open.extend(ordered.iter().chain(against).map(|other| (room.clone(), other.clone())));
        before.insert(room);
    }
    let rooms: BTreeSet<String> = sources().into_iter().map(|(room, _)| room).collect();
    assert_eq!(
        rooms,
        before.into_iter().cloned().collect::<BTreeSet<String>>(),
        "the rooms of src/ and those of the list"
    );
    for (door, place) in &doors {
        assert!(open.contains(door), "{} → {} is not listed: {place}", door.0, door.1);
    }
    for door in &open {
        assert!(
            doors.contains_key(door),
            "{} → {} is listed and no longer used: take it away",
            door.0,
            door.1
        );
    }
}

#[test]
fn paths_are_read_through_their_braces() {
    let code = "pub use crate::board::{Arithmetic, Hand};\nuse crate::{files, a::{b, c::{self, d as e}}};";
    let found: Vec<(String, bool)> =
        crate_paths(code).into_iter().map(|(p, again)| (p.join("::"), again)).collect();
    let expected = [
        ("board::Arithmetic", true),
        ("board::Hand", true),
        ("files", false),
        ("a::b", false),
        ("a::c", false),
        ("a::c::d", false),
    ];
    assert_eq!(found, expected.map(|(path, again)| (path.to_owned(), again)));
}
