//! `linkgram grade` as its users meet it: a scene file, an answer file, a report.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::campaign::Case;

/// Runs the program in a folder: its exit status, the JSON that it printed, and what it said on standard error.
pub(crate) fn program(folder: &Path, arguments: &[&str]) -> (Option<i32>, Value, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).current_dir(folder).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), serde_json::from_slice(&output.stdout).unwrap_or(Value::Null), said)
}

/// A folder that goes away with its owner.
#[derive(Debug)]
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-planted-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// What the report says, as far as this test looks at it.
#[derive(Debug)]
pub(crate) struct Judgement {
    /// Every judged quantity with its verdict.
    pub(crate) verdicts: Vec<(String, String)>,
    /// Those of them that the program itself says no careful hand can measure: nobody should be asked for them.
    pub(crate) unmeasurable: BTreeSet<String>,
    /// Quantity at which the first fault stands, and the mistakes by which it is explained, best first.
    pub(crate) fault: Option<(String, Vec<String>)>,
    /// Kinds of the mistakes that are given for any wrong answer.
    pub(crate) named: BTreeSet<String>,
}

impl Judgement {
    pub(crate) fn of(report: &Value) -> Self {
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let quantities = report["quantities"].as_array().unwrap();
        let verdicts = quantities.iter().map(|q| (text(&q["name"]), text(&q["verdict"]))).collect();
        let loose = quantities.iter().filter(|q| q["measurable"] == Value::Bool(false));
        let unmeasurable = loose.map(|q| text(&q["name"])).collect();
        let fault = report.get("first_fault").filter(|f| !f.is_null()).map(|fault| {
            let mistakes = fault["mistakes"]
                .as_array()
                .map_or_else(Vec::new, |all| all.iter().map(|m| text(&m["kind"])).collect());
            (text(&fault["name"]), mistakes)
        });
        let given = quantities.iter().filter_map(|q| q["mistakes"].as_array()).flatten();
        let named = given.map(|m| text(&m["kind"])).collect();
        Self { verdicts, unmeasurable, fault, named }
    }

    /// The diagnosis that is ranked first.
    pub(crate) fn first(&self) -> &str {
        match &self.fault {
            None => "(right)",
            Some((_, mistakes)) => mistakes.first().map_or("(none fits)", String::as_str),
        }
    }
}

/// Hands a case in.
///
/// # Panics
/// If the program refuses it, or its exit status contradicts its report.
pub(crate) fn grade(case: &Case, folder: &Path) -> Judgement {
    let answers = format!("answers.{}", case.sheet.extension);
    std::fs::write(folder.join("scene.json"), &case.scene).unwrap();
    std::fs::write(folder.join(&answers), &case.sheet.text).unwrap();
    let (status, report, said) = program(folder, &["grade", "scene.json", &answers, "--json"]);
    assert!(matches!(status, Some(0 | 1)), "{status:?} {said}\n{}\n{}", case.scene, case.sheet.text);
    let judgement = Judgement::of(&report);
    let wrong = judgement.verdicts.iter().any(|(_, v)| v == "wrong");
    assert_eq!(status == Some(1), wrong, "exit status and report\n{report}");
    judgement
}
