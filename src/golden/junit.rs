//! A report as JUnit's XML, which the servers that run tests read.

use super::{Report, Verdict};

/// The report in the XML of JUnit: a test case for each golden.
#[must_use]
pub fn junit(report: &Report) -> String {
    let count = report.count();
    let errors = count.unreadable + count.broken;
    let failures = report.checked.len() - count.same - errors;
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"linkgram golden\" tests=\"{}\" \
         failures=\"{failures}\" errors=\"{errors}\">\n",
        report.checked.len()
    );
    for one in &report.checked {
        let name = escaped(&one.name);
        let element = match one.verdict {
            Verdict::Same => {
                xml.push_str(&format!("<testcase classname=\"golden\" name=\"{name}\"/>\n"));
                continue;
            }
            Verdict::Unreadable(_) | Verdict::Broken(_) => "error",
            _ => "failure",
        };
        let mut lines = one.verdict.lines();
        lines.splice(0..0, one.because());
        let first = lines.first().map_or("", String::as_str);
        xml.push_str(&format!(
            "<testcase classname=\"golden\" name=\"{name}\">\n<{element} type=\"{}\" message=\"{}\">{}</{element}>\n\
             </testcase>\n",
            one.verdict.word(),
            escaped(first),
            escaped(&lines.join("\n")),
        ));
    }
    xml + "</testsuite>\n</testsuites>\n"
}

/// Text in XML, with nothing that XML has not.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push('\n'),
            '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' => out.push(' '),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}
