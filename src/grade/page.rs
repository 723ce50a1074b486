//! A report as a page of hypertext for one student: to be printed on one sheet, or sent.

use crate::markup::escaped;
use std::fmt::Write as _;

use super::judge::Verdict;
use super::report::Report;
use super::text::{marks, sentences};

const STYLE: &str = "\
@page{size:A4;margin:15mm}\
body{font:11pt/1.35 Georgia,'Times New Roman',serif;max-width:180mm;margin:1em auto;color:#111}\
h1{font-size:15pt;margin:0}\
p.who{margin:.2em 0 1em}\
table{border-collapse:collapse;width:100%;font-size:10pt}\
th{text-align:left;border-bottom:1.5px solid #111}\
td{border-bottom:.5px solid #999;vertical-align:top}\
th,td{padding:.2em .6em .2em 0}\
td.n{text-align:right;white-space:nowrap}\
tr.wrong td:first-child::before{content:'\u{2717} '}\
tr.right td:first-child::before{content:'\u{2713} '}\
tr.consistent td:first-child::before{content:'\u{21b3} '}\
tr.missing{color:#555}\
tr.unread td:first-child::before{content:'? '}\
p.sum{font-weight:bold;text-align:right;margin:.4em 0 1em}\
ol{padding-left:1.2em}\
figure{margin:1em 0;break-inside:avoid}\
figure svg{max-width:100%;height:auto;max-height:150mm}\
small{color:#444}";

/// Units as people write them.
fn unit(text: &str) -> String {
    text.replace("^2", "²").replace("^3", "³").replace('*', "·").replace(" deg", "°")
}

impl Report {
    /// The report as a page of hypertext, with the overlay (an SVG) where there is one.
    #[must_use]
    pub fn to_html(&self, title: &str, overlay: Option<&str>) -> String {
        let who = self.student.as_deref().unwrap_or("");
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n<style>{STYLE}</style>\n\
             </head>\n<body>\n<h1>{}</h1>\n<p class=\"who\">{}</p>\n",
            escaped(&[who, title].into_iter().filter(|t| !t.is_empty()).collect::<Vec<_>>().join(": ")),
            escaped(title),
            escaped(who),
        );
        for note in self.notes() {
            let _ = writeln!(page, "<p>{}</p>", escaped(&note));
        }
        page.push_str(
            "<table>\n<tr><th>asked</th><th>yours</th><th>right</th><th>verdict</th><th class=\"n\">marks</th></tr>\n",
        );
        for graded in &self.quantities {
            let right = match graded.right.is_empty() {
                true => String::new(),
                false => graded.expected_within(),
            };
            let verdict = match (graded.verdict, graded.wrong_in()) {
                (Verdict::Wrong, Some(part)) => format!("wrong: {part}"),
                (verdict, _) if graded.charged => format!("{}, which costs its mark here", verdict.told()),
                (verdict, _) => match graded.silent() {
                    Some(untold) => format!("{}, but its {untold} is not told", verdict.told()),
                    None => verdict.told().to_owned(),
                },
            };
            let _ = writeln!(
                page,
                "<tr class=\"{}\"><td>{}</td><td><bdi>{}</bdi></td><td><bdi>{}</bdi></td><td>{}</td><td class=\"n\">{}</td></tr>",
                graded.verdict.name(),
                self.symbols.html(&graded.name),
                unit(&escaped(&graded.handed_in())),
                unit(&escaped(&right)),
                verdict,
                match graded.asked {
                    true => format!("{} of {}", marks(graded.reached()), marks(graded.weight)),
                    false => "no marks".to_owned(),
                },
            );
        }
        if !self.missing.is_empty() {
            let names: Vec<&str> = self.missing.iter().map(|(name, _)| name.as_str()).collect();
            let weight: f64 = self.missing.iter().map(|(_, weight)| weight).sum();
            let _ = writeln!(
                page,
                "<tr class=\"missing\"><td colspan=\"4\">not answered: {}</td><td class=\"n\">0 of {}</td></tr>",
                self.symbols.html(&names.join(", ")),
                marks(weight),
            );
        }
        for one in &self.not_read {
            let _ = writeln!(
                page,
                "<tr class=\"unread\"><td>{}</td><td colspan=\"3\">not read: <bdi>{}</bdi></td><td class=\"n\">{}</td></tr>",
                self.symbols.html(&one.name),
                escaped(&one.why.to_string()),
                if one.weight > 0.0 { format!("0 of {}", marks(one.weight)) } else { "no marks".to_owned() },
            );
        }
        let (reached, of) = self.sum();
        let _ = writeln!(page, "</table>\n<p class=\"sum\">{} of {} marks</p>", marks(reached), marks(of));
        let wrong: Vec<_> =
            self.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).collect();
        if !wrong.is_empty() && self.other_variant.is_none() {
            page.push_str("<ol>\n");
            for graded in wrong {
                let said = sentences(graded).join(" ");
                let (name, said) = (self.symbols.html(&graded.name), self.symbols.html(&said));
                let _ = writeln!(page, "<li><b>{name}</b>: {said}</li>");
            }
            page.push_str("</ol>\n");
        }
        if let Some(svg) = overlay {
            let start = svg.find("<svg").unwrap_or(0);
            let _ = writeln!(page, "<figure>\n{}\n</figure>", &svg[start..]);
        }
        page.push_str("<p><small>How far an answer may be off: ");
        let because: Vec<String> =
            self.quantities.iter().map(|graded| format!("{}: {}", graded.name, graded.because())).collect();
        page.push_str(&unit(&self.symbols.html(&because.join("; "))));
        page.push_str(".</small></p>\n</body>\n</html>\n");
        page
    }
}
