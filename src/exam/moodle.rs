//! Question banks in Moodle's XML format, as its own export writes them (`question/format/xml` of Moodle 4):
//! questions with their figures inside, base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::answer::{WITHOUT_SENSE, whole_weights};
use super::bank::{Bank, Item, escaped, unit};
use super::{KeyAnswer, Variant};
use crate::sheet::Part;

/// For each number that is to be handed in a bank of its own: one question of type `numerical` per variant, in
/// a category from which Moodle draws one at random. Tolerances are absolute. (All in one file would hold every
/// figure many times, more than a site lets upload.)
#[must_use]
pub fn numerical(bank: &Bank<'_>) -> Vec<String> {
    let count = bank.items.first().map_or(0, |item| item.prompts.len());
    (0..count).map(|index| numerical_of(bank, index)).collect()
}

fn numerical_of(bank: &Bank<'_>, index: usize) -> String {
    let mut out = head();
    for (place, item) in bank.items.iter().enumerate() {
        if let (Some(answer), Some(prompt)) = (item.variant.answers.get(index), item.prompts.get(index)) {
            if place == 0 {
                out.push_str(&category(&[&bank.title, &label(answer)]));
            }
            let body =
                format!("{}<p><strong>{prompt}</strong> = ? {}</p>", figure(bank, item), unit(&answer.unit));
            out.push_str("  <question type=\"numerical\">\n");
            let name = format!("{} · {}", bank.name(item), label(answer));
            let feedback = Feedback::Number(answer, prompt);
            out.push_str(&common(bank, item, &name, &body, answer.weight, feedback));
            let right = answer.spellings().into_iter().map(|spelling| (100.0, spelling));
            for (fraction, spelling) in right.chain(answer.opposite().map(|other| (WITHOUT_SENSE, other))) {
                out.push_str(&format!(
                    "    <answer fraction=\"{fraction}\" format=\"moodle_auto_format\">\n      <text>{spelling}</text>\n      \
                     <feedback format=\"html\"><text></text></feedback>\n      <tolerance>{}</tolerance>\n    </answer>\n",
                    answer.printed_tolerance()
                ));
            }
            // No unit is graded: the question states it.
            out.push_str(
                "    <unitgradingtype>0</unitgradingtype>\n    <unitpenalty>0.1</unitpenalty>\n    \
                 <showunits>3</showunits>\n    <unitsleft>0</unitsleft>\n  </question>\n",
            );
        }
    }
    out + "</quiz>\n"
}

/// One question of type `cloze` per variant, with a field for every number.
#[must_use]
pub fn cloze(bank: &Bank<'_>) -> String {
    let mut out = head();
    out.push_str(&category(&[&bank.title]));
    for item in &bank.items {
        let mut body = figure(bank, item);
        body.push_str("<ul>");
        let weights: Vec<f64> = item.variant.answers.iter().map(|answer| answer.weight).collect();
        let weights = whole_weights(&weights);
        let total: u32 = weights.iter().sum();
        for ((answer, prompt), weight) in item.variant.answers.iter().zip(&item.prompts).zip(weights) {
            body.push_str(&format!("<li>{prompt}: {} {}</li>", field(answer, weight), unit(&answer.unit)));
        }
        body.push_str("</ul>");
        out.push_str("  <question type=\"cloze\">\n");
        out.push_str(&common(bank, item, &bank.name(item), &body, f64::from(total), Feedback::Sheet));
        out.push_str("  </question>\n");
    }
    out + "</quiz>\n"
}

/// `{1:NUMERICAL:=175.3:2.3}`; every spelling of a direction earns all, a rotation with the wrong sense a part.
fn field(answer: &KeyAnswer, weight: u32) -> String {
    let tolerance = answer.printed_tolerance();
    let mut right: Vec<String> = answer.spellings().iter().map(|s| format!("={s}:{tolerance}")).collect();
    right.extend(answer.opposite().map(|other| format!("%{WITHOUT_SENSE}%{other}:{tolerance}")));
    format!("{{{weight}:NUMERICAL:{}}}", right.join("~"))
}

/// What is told after an attempt.
#[derive(Clone, Copy)]
enum Feedback<'a> {
    /// The right number.
    Number(&'a KeyAnswer, &'a str),
    /// The whole solution.
    Sheet,
}

/// The name of a number: `v(B)`, `v(B) direction`.
fn label(answer: &KeyAnswer) -> String {
    match answer.part {
        Part::Value => answer.name.clone(),
        part => format!("{} {}", answer.name, part.name()),
    }
}

fn head() -> String {
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n".to_owned()
}

/// A category under the course's own; a slash inside a name is doubled.
fn category(names: &[&str]) -> String {
    let path: Vec<String> = names.iter().map(|name| escaped(&name.replace('/', "//"))).collect();
    format!(
        "  <question type=\"category\">\n    <category><text>$course$/top/{}</text></category>\n    \
         <info format=\"html\"><text></text></info>\n    <idnumber></idnumber>\n  </question>\n",
        path.join("/")
    )
}

fn file_name(variant: &Variant) -> String {
    format!("{}.svg", variant.name())
}

/// The figure and the task, as hypertext.
fn figure(bank: &Bank<'_>, item: &Item<'_>) -> String {
    let words = bank.language.words();
    format!(
        "<p dir=\"{}\" lang=\"{}\">{}</p><p><img src=\"@@PLUGINFILE@@/{}\" alt=\"{}\" class=\"img-fluid\"/></p>",
        bank.direction(),
        words.tag,
        escaped(words.by_drawing),
        file_name(item.variant),
        escaped(words.question),
    )
}

fn solution_name(variant: &Variant) -> String {
    format!("{}.solution.svg", variant.name())
}

/// What is told after an attempt: the right numbers, and of a whole question the sheet of the solution.
fn feedback(bank: &Bank<'_>, item: &Item<'_>, which: Feedback<'_>) -> String {
    let line = |answer: &KeyAnswer, prompt: &str| {
        format!("<li>{prompt} = <bdi dir=\"ltr\">{} {}</bdi></li>", answer.printed(), unit(&answer.unit))
    };
    let (lines, figure): (String, bool) = match which {
        Feedback::Number(answer, prompt) => (line(answer, prompt), false),
        Feedback::Sheet => {
            let pairs = item.variant.answers.iter().zip(&item.prompts);
            (pairs.map(|(answer, prompt)| line(answer, prompt)).collect(), true)
        }
    };
    let words = bank.language.words();
    let mut text = format!("<div dir=\"{}\" lang=\"{}\"><ul>{lines}</ul>", bank.direction(), words.tag);
    let mut file = String::new();
    if figure {
        let name = solution_name(item.variant);
        text.push_str(&format!(
            "<p><img src=\"@@PLUGINFILE@@/{name}\" alt=\"{}\" class=\"img-fluid\"/></p>",
            escaped(words.results)
        ));
        file = format!(
            "\n      <file name=\"{name}\" path=\"/\" encoding=\"base64\">{}</file>",
            STANDARD.encode(&item.solution)
        );
    }
    text.push_str("</div>");
    format!(
        "    <generalfeedback format=\"html\">\n      <text><![CDATA[{}]]></text>{file}\n    </generalfeedback>\n",
        text.replace("]]>", "]]]]><![CDATA[>")
    )
}

/// What questions of both types have.
fn common(
    bank: &Bank<'_>,
    item: &Item<'_>,
    name: &str,
    body: &str,
    grade: f64,
    told: Feedback<'_>,
) -> String {
    let body =
        format!("<div dir=\"{}\" lang=\"{}\">{body}</div>", bank.direction(), bank.language.words().tag);
    format!(
        "    <name><text>{}</text></name>\n    <questiontext format=\"html\">\n      <text><![CDATA[{}]]></text>\n      \
         <file name=\"{}\" path=\"/\" encoding=\"base64\">{}</file>\n    </questiontext>\n{}    \
         <defaultgrade>{grade}</defaultgrade>\n    <penalty>0.3333333</penalty>\n    <hidden>0</hidden>\n    \
         <idnumber></idnumber>\n",
        escaped(name),
        body.replace("]]>", "]]]]><![CDATA[>"),
        file_name(item.variant),
        STANDARD.encode(&item.figure),
        feedback(bank, item, told),
    )
}
