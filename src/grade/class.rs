//! A whole class: the marks of each as a table, and which faults how many made.

use std::collections::BTreeMap;

use super::is_prime;
use super::judge::Verdict;
use super::phrase::{Phrase, say};
use super::report::{Graded, Report};
use super::text::marks;

/// One hand-in of a class.
#[derive(Debug, Clone, PartialEq)]
pub struct HandIn {
    /// Its file.
    pub file: String,
    /// How it was graded; why it was not, where it cannot be read.
    pub outcome: Result<Report, String>,
}

/// What stands in the place of a mistake where somebody hands in the answers of another variant.
const OTHER_VARIANT: &str = "other-variant";
/// The same of a field that is not understood.
const NOT_READ: &str = "not-read";

/// A fault that several made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassFault {
    /// The name of the mistake; `unknown` where none of the known fits.
    pub kind: &'static str,
    /// The answer at which it shows.
    pub at: String,
    /// What it is, in words.
    pub text: String,
    /// How many students made it.
    pub students: usize,
}

/// Which faults were made how often, the most frequent first. Whoever makes one twice counts once.
#[must_use]
pub fn class_faults(class: &[HandIn]) -> Vec<ClassFault> {
    // In words, with what all of them have in common, and how often.
    let mut found: BTreeMap<(&'static str, String), ([String; 2], usize)> = BTreeMap::new();
    for report in class.iter().filter_map(|one| one.outcome.as_ref().ok()) {
        let mut own: BTreeMap<(&'static str, String), [String; 2]> = BTreeMap::new();
        let said = |phrase: &Phrase| [report.says(phrase), report.says(phrase)];
        if let Some(variant) = &report.other_variant {
            let text = say!("the answers of variant {}", variant);
            own.insert((OTHER_VARIANT, variant.clone()), said(&text));
        }
        own.extend(
            report
                .not_read
                .iter()
                .map(|one| ((NOT_READ, one.name.clone()), said(&say!("{}: not read", one.name)))),
        );
        let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong);
        for graded in wrong.filter(|_| report.other_variant.is_none()) {
            match graded.mistakes.first() {
                Some(mistake) => own.extend(mistake.parts().map(|part| {
                    let texts = [part.own_text(), part.kind_text()].map(|text| report.says(&text));
                    ((part.kind.name(), part.at.to_string()), texts)
                })),
                None => {
                    let text = say!("{}: no known mistake fits", graded.name);
                    own.insert(("unknown", graded.name.clone()), said(&text));
                }
            }
        }
        for (key, texts) in own {
            let (known, students) = found.entry(key).or_insert_with(|| (texts.clone(), 0));
            *students += 1;
            // One read bc, another ac: the class read another vector.
            let [told, in_common] = known;
            if *told != texts[0] {
                told.clone_from(in_common);
            }
        }
    }
    let mut faults: Vec<ClassFault> = found
        .into_iter()
        .map(|((kind, at), ([text, _], students))| ClassFault { kind, at, text, students })
        .collect();
    faults.sort_by_key(|fault| std::cmp::Reverse(fault.students));
    faults
}

/// One line per hand-in: marks, the first fault, the verdict on each answer.
#[must_use]
pub fn class_csv(class: &[HandIn]) -> String {
    let mut names: Vec<String> = Vec::new();
    let reports = || class.iter().filter_map(|one| one.outcome.as_ref().ok());
    for report in reports() {
        let own = report.quantities.iter().map(asked_as);
        let unread = report.not_read.iter().map(|one| one.name.as_str());
        let missing = report.missing.iter().map(|(name, _)| name.as_str());
        for name in own.chain(missing).chain(unread).map(column) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    let mut text = String::from("file,student,marks,of,percent,first fault,mistake");
    for name in &names {
        text.push(',');
        text.push_str(&field(name));
    }
    text.push('\n');
    for one in class {
        let mut fields = vec![field(&one.file)];
        match &one.outcome {
            Err(why) => {
                fields.extend([String::new(), String::new(), String::new(), String::new()]);
                fields.extend([field("not graded"), field(why)]);
                fields.extend(names.iter().map(|_| String::new()));
            }
            Ok(report) => {
                let (reached, of) = report.sum();
                let percent = if of > 0.0 { format!("{:.1}", 100.0 * reached / of) } else { String::new() };
                let fault = report.first_fault().filter(|_| report.other_variant.is_none());
                let first = fault.map_or("", |fault| fault.name);
                let mistake = fault.map_or(String::new(), |fault| {
                    fault.mistakes.first().map_or("unknown".to_owned(), |m| m.kind.name().to_owned())
                });
                let mistake = report
                    .other_variant
                    .as_ref()
                    .map_or(mistake, |variant| format!("{OTHER_VARIANT} {variant}"));
                fields.push(field(report.student.as_deref().unwrap_or("")));
                fields.extend([marks(reached), marks(of), percent, field(first), field(&mistake)]);
                fields.extend(names.iter().map(|name| {
                    let graded = report.quantities.iter().find(|graded| column(asked_as(graded)) == *name);
                    let missing = report.missing.iter().any(|(missing, _)| column(missing) == *name);
                    let unread = report.not_read.iter().any(|one| column(&one.name) == *name);
                    let silent = match (unread, missing) {
                        (true, _) => NOT_READ,
                        (false, true) => "missing",
                        (false, false) => "",
                    };
                    graded.map_or(silent.to_owned(), |graded| {
                        let silent = graded.silent().map(|untold| format!(" without {untold}"));
                        format!("{}{}", graded.verdict.name(), silent.unwrap_or_default())
                    })
                }));
            }
        }
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

/// What an answer is called: as the scene asks for it, however somebody writes it.
fn asked_as(graded: &Graded) -> &str {
    graded.find.as_deref().unwrap_or(&graded.name)
}

/// The column of an answer: a point of a figure has one, with whatever primes and strokes somebody writes its letter.
fn column(name: &str) -> String {
    match name.split_once(':') {
        Some((figure, point)) => {
            let plain = point.chars().filter(|c| !is_prime(*c) && !matches!(c, ',' | '_' | ' '));
            format!("{figure}:{}", plain.collect::<String>())
        }
        None => name.to_owned(),
    }
}

/// The faults of a class as a table.
#[must_use]
pub fn faults_csv(faults: &[ClassFault]) -> String {
    let mut text = String::from("students,mistake,at,text\n");
    for fault in faults {
        let fields = [fault.students.to_string(), field(fault.kind), field(&fault.at), field(&fault.text)];
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

/// A field of a table: nothing that a spreadsheet would compute, in quotes where it needs them.
fn field(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let text = if text.starts_with(['=', '+', '-', '@']) { format!("'{text}") } else { text };
    if text.contains([',', ';', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}
