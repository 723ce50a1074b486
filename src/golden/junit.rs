//! A report as JUnit's XML, which the servers that run tests read.

use super::{Report, Verdict};
use crate::markup::escaped;

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
