//! A report as a page of hypertext for one student: to be printed on one sheet, or sent.

use crate::markup::escaped;
use std::fmt::Write as _;

use super::judge::Verdict;
use super::phrase::{Phrase, say};
use super::report::Report;
use super::text::{marks, sentence};

/// On paper the figure takes what the rest leaves of one sheet.
const STYLE: &str = "\
@page{size:A4;margin:15mm}\
body{font:11pt/1.35 Georgia,'Times New Roman',serif;max-width:180mm;margin:1em auto;color:#111}\
h1{font-size:15pt;margin:0}\
p.who{margin:.2em 0 1em}\
table{border-collapse:collapse;width:100%;font-size:10pt}\
th{text-align:start;border-bottom:1.5px solid #111}\
td{border-bottom:.5px solid #999;vertical-align:top}\
th,td{padding-block:.2em;padding-inline:0 .6em}\
th.n,td.n{text-align:end;white-space:nowrap}\
td:first-child:not([colspan]){white-space:nowrap}\
tr.wrong td:first-child::before{content:'\u{2717} '}\
tr.right td:first-child::before{content:'\u{2713} '}\
tr.consistent td:first-child::before{content:'\u{21b3} '}\
tr.missing{color:#555}\
tr.unread td:first-child::before{content:'? '}\
p.sum{font-weight:bold;text-align:end;margin:.4em 0 1em}\
ol{padding-inline-start:1.2em}\
figure{direction:ltr;margin:1em 0;break-inside:avoid}\
figure svg{max-width:100%;height:auto;max-height:150mm}\
small{color:#444}\
@media print{\
body{margin:0;max-width:none;display:flex;flex-direction:column;height:266mm;font-size:10pt;line-height:1.25}\
table{font-size:9pt}\
p.who{margin:.1em 0 .4em}\
p.sum{margin:.2em 0 .4em}\
ol{margin:.2em 0}\
th,td{padding-block:.1em}\
figure{flex:1 1 0;min-height:90mm;margin:.3em 0}\
figure svg{display:block;width:100%;height:100%;max-height:none}\
small{display:block;font-size:7.5pt;line-height:1.15}}";

/// Units as people write them.
fn unit(text: &str) -> String {
    text.replace("^2", "²").replace("^3", "³").replace('*', "·").replace(" deg", "°")
}

/// Whether a sign is a letter of Arabic script.
fn is_arabic(sign: char) -> bool {
    sign.is_alphabetic()
        && matches!(sign, '\u{600}'..='\u{6ff}' | '\u{750}'..='\u{77f}' | '\u{8a0}'..='\u{8ff}')
}

impl Report {
    /// A sentence as hypertext, with names as the sheet prints them.
    fn html(&self, phrase: &Phrase) -> String {
        self.symbols.html(&phrase.told(self.language))
    }

    /// Numbers with their units, each of which runs from left to right in every language, among words that need not.
    fn numbers(&self, phrase: &Phrase) -> String {
        let told = unit(&escaped(&phrase.told(self.language)));
        if !self.language.words().right_to_left {
            return format!("<bdi>{told}</bdi>");
        }
        let mut text = String::from("<bdi dir=\"rtl\">");
        let mut rest = &told[..];
        while let Some(first) = rest.chars().next() {
            let word = is_arabic(first);
            let end = rest.find(|sign| is_arabic(sign) != word).unwrap_or(rest.len());
            let (run, after) = rest.split_at(end);
            let bare = run.trim();
            if word || bare.is_empty() {
                text.push_str(run);
            } else {
                let [before, behind] = [run.len() - run.trim_start().len(), run.trim_end().len()];
                let _ = write!(text, "{}<bdi dir=\"ltr\">{bare}</bdi>{}", &run[..before], &run[behind..]);
            }
            rest = after;
        }
        text.push_str("</bdi>");
        text
    }

    /// The report as a page of hypertext, with the overlay (an SVG) where there is one.
    #[must_use]
    pub fn to_html(&self, title: &str, overlay: Option<&str>) -> String {
        let who = self.student.as_deref().unwrap_or("");
        let words = self.language.words();
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"{}\" dir=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n<style>{STYLE}</style>\n\
             </head>\n<body>\n<h1>{}</h1>\n<p class=\"who\">{}</p>\n",
            words.tag,
            if words.right_to_left { "rtl" } else { "ltr" },
            escaped(&[who, title].into_iter().filter(|t| !t.is_empty()).collect::<Vec<_>>().join(": ")),
            escaped(title),
            escaped(who),
        );
        for note in self.notes() {
            let _ = writeln!(page, "<p>{}</p>", unit(&escaped(&note.told(self.language))));
        }
        page.push_str("<table>\n<tr>");
        for head in [say!("asked"), say!("yours"), say!("right"), say!("verdict")] {
            let _ = write!(page, "<th>{}</th>", head.told(self.language));
        }
        let _ = writeln!(page, "<th class=\"n\">{}</th></tr>", say!("marks").told(self.language));
        for graded in &self.quantities {
            let right = match graded.right.is_empty() {
                true => Phrase::from(""),
                false => graded.expected_within(),
            };
            let marks = match graded.asked {
                true => say!("{} of {}", marks(graded.reached()), marks(graded.weight)),
                false => say!("no marks"),
            };
            let _ = writeln!(
                page,
                "<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td></tr>",
                graded.verdict.name(),
                self.symbols.html(&graded.name),
                self.numbers(&graded.handed_in()),
                self.numbers(&right),
                graded.judged().told(self.language),
                marks.told(self.language),
            );
        }
        if !self.missing.is_empty() {
            let weight: f64 = self.missing.iter().map(|(_, weight)| weight).sum();
            let _ = writeln!(
                page,
                "<tr class=\"missing\"><td colspan=\"4\">{}</td><td class=\"n\">{}</td></tr>",
                self.html(&say!("not answered: {}", self.names_of_missing())),
                say!("{} of {}", "0", marks(weight)).told(self.language),
            );
        }
        for one in &self.not_read {
            let marks = match one.weight > 0.0 {
                true => say!("{} of {}", "0", marks(one.weight)),
                false => say!("no marks"),
            };
            let why = format!("<bdi>{}</bdi>", escaped(&one.why.to_string()));
            let _ = writeln!(
                page,
                "<tr class=\"unread\"><td>{}</td><td colspan=\"3\">{}</td><td class=\"n\">{}</td></tr>",
                self.symbols.html(&one.name),
                say!("not read: {}", why).told(self.language),
                marks.told(self.language),
            );
        }
        let (reached, of) = self.sum();
        let sum = say!("{} of {} marks", marks(reached), marks(of)).told(self.language);
        let _ = writeln!(page, "</table>\n<p class=\"sum\">{sum}</p>");
        let wrong: Vec<_> =
            self.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).collect();
        if !wrong.is_empty() && self.other_variant.is_none() {
            page.push_str("<ol>\n");
            for graded in wrong {
                let (name, said) = (self.symbols.html(&graded.name), self.html(&sentence(graded)));
                let _ = writeln!(page, "<li><b>{name}</b>: {said}</li>");
            }
            page.push_str("</ol>\n");
        }
        if let Some(svg) = overlay {
            let start = svg.find("<svg").unwrap_or(0);
            let _ = writeln!(page, "<figure>\n{}\n</figure>", &svg[start..]);
        }
        let because: Vec<String> = self
            .quantities
            .iter()
            .map(|graded| format!("{}: {}", graded.name, graded.because().told(self.language)))
            .collect();
        let because = say!("How far an answer may be off: {}.", because.join("; "));
        let _ = writeln!(page, "<p><small>{}</small></p>", unit(&self.html(&because)));
        page.push_str("</body>\n</html>\n");
        page
    }
}
