//! What became otherwise in a scene since its figure was blessed.

use serde_json::Value;

use crate::report::short;

/// The scene as it was when its golden was blessed, against the scene as it is: a clause for each value that changed, came
/// or went, the largest change first. `None` where one of the two is no JSON.
pub(super) fn changes(old: &str, new: &str) -> Option<Vec<String>> {
    let (old, new): (Value, Value) = (serde_json::from_str(old).ok()?, serde_json::from_str(new).ok()?);
    let mut found = Vec::new();
    compare("", &old, &new, &mut found);
    found.sort_by(|a: &(f64, String), b| b.0.total_cmp(&a.0));
    Some(found.into_iter().map(|(_, what)| what).collect())
}

/// What is not a number counts as changed as a whole.
const WHOLE: f64 = 1.0;

fn compare(path: &str, old: &Value, new: &Value, found: &mut Vec<(f64, String)>) {
    match (old, new) {
        (Value::Object(a), Value::Object(b)) => {
            let at = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
            for (key, old) in a {
                match b.get(key) {
                    Some(new) => compare(&at(key), old, new, found),
                    None => found.push((WHOLE, format!("{} is gone (was {})", at(key), told(old)))),
                }
            }
            let added = b.iter().filter(|(key, _)| !a.contains_key(*key));
            found.extend(added.map(|(key, new)| (WHOLE, format!("{} is new: {}", at(key), told(new)))));
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (index, (old, new)) in a.iter().zip(b).enumerate() {
                compare(&format!("{path}[{index}]"), old, new, found);
            }
        }
        (old, new) if old == new => {}
        (Value::Number(a), Value::Number(b)) => {
            let (x, y) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            // 180 and 180.0 are one number.
            if x != y {
                let largest = x.abs().max(y.abs());
                let size = if largest > 0.0 { (x - y).abs() / largest } else { 0.0 };
                found.push((size, format!("{path} {a} → {b}")));
            }
        }
        (old, new) => found.push((WHOLE, format!("{path} {} → {}", told(old), told(new)))),
    }
}

/// A value, cut where it is long.
fn told(value: &Value) -> String {
    const MOST: usize = 60;
    let text = match value {
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), short),
        value => value.to_string(),
    };
    if text.chars().count() <= MOST { text } else { text.chars().take(MOST).collect::<String>() + "…" }
}

#[cfg(test)]
mod tests {
    use super::changes;

    #[test]
    fn every_change_is_told_at_its_path_the_largest_first() {
        let old = r#"{ "links": { "2": { "length": 180 } }, "slides": [{ "on": { "angle": 0 } }], "find": ["v(A)"], "near": {} }"#;
        let new = r#"{ "links": { "2": { "length": 180.18 } }, "slides": [{ "on": { "angle": 30 } }], "find": ["v(A)", "v(B)"], "title": "x" }"#;
        assert_eq!(
            changes(old, new).unwrap(),
            [
                "slides[0].on.angle 0 → 30",
                "find [\"v(A)\"] → [\"v(A)\",\"v(B)\"]",
                "near is gone (was {})",
                "title is new: \"x\"",
                "links.2.length 180 → 180.18",
            ]
        );
        assert_eq!(changes("{\"a\": 180}", "{ \"a\": 180.0 }").unwrap(), [""; 0]);
        assert_eq!(changes("{", "{}"), None);
    }
}
