//! A report as a page of hypertext for one student: to be printed on one sheet, or sent.

use crate::markup::escaped;
use std::fmt::Write as _;

use super::judge::Verdict;
use super::phrase::{Phrase, say};
use super::report::{Allowed, Graded, Report};
use super::text::{digits, marks, sentence};

/// On paper the figure keeps its size: names are to be read. What has no room goes on overleaf.
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
table.short td:nth-child(2):not([colspan]),table.short td:nth-child(3){white-space:nowrap}\
tr.missing{color:#555}\
tr.unread td:first-child::before{content:'? '}\
p.sum{font-weight:bold;text-align:end;margin:.4em 0 1em}\
ol{padding-inline-start:1.2em}\
figure{direction:ltr;margin:1em 0;break-inside:avoid}\
figure svg{display:block;max-width:100%;height:auto}\
small{color:#444}\
@media print{\
body{margin:0;max-width:none;font-size:10pt;line-height:1.25}\
table{font-size:9pt}\
tr,li{break-inside:avoid}\
p.who{margin:.1em 0 .4em}\
p.sum{margin:.2em 0 .4em}\
ol{margin:.2em 0}\
th,td{padding-block:.1em}\
figure{margin:3mm 0}\
small{display:block;font-size:7.5pt;line-height:1.15}}";

/// The part of an SVG between its opening tag and its end, or what of it is seen between two heights: the drawing itself the first
/// time, then the same once more.
fn cut(svg: &str, strips: &[(f64, f64)]) -> String {
    let start = svg.find("<svg").unwrap_or(0);
    let whole = &svg[start..];
    let Some((tag, inside)) = whole.split_once('>').filter(|_| strips.len() > 1) else {
        return format!("<figure>\n{whole}\n</figure>\n");
    };
    let attribute = |name: &str| {
        let at = tag.find(&format!(" {name}=\""))? + name.len() + 3;
        Some((at, at + tag[at..].find('"')?))
    };
    let (Some(height), Some(window)) = (attribute("height"), attribute("viewBox")) else {
        return format!("<figure>\n{whole}\n</figure>\n");
    };
    let width = tag[window.0..window.1].split(' ').nth(2).unwrap_or_default();
    let mut all = String::new();
    for (place, (top, bottom)) in strips.iter().enumerate() {
        let (top, high) = (top - BLANK, bottom - top + 2.0 * BLANK);
        let mut own = tag.to_owned();
        let mut set = [(height, format!("{high:.3}mm")), (window, format!("0 {top:.3} {width} {high:.3}"))];
        // From behind, so that the places before stay.
        set.sort_by_key(|((at, _), _)| std::cmp::Reverse(*at));
        for ((from, to), value) in set {
            own.replace_range(from..to, &value);
        }
        let _ = if place == 0 {
            // The same name in every report: a page has one.
            let inside =
                inside.replacen("<g class=\"overlay\"", &format!("<g id=\"{ID}\" class=\"overlay\""), 1);
            writeln!(all, "<figure>\n{own}>{inside}\n</figure>")
        } else {
            let own = own.replace(" role=\"img\"", " aria-hidden=\"true\"");
            let own = match own.split_once(" aria-labelledby=\"") {
                Some((before, after)) => {
                    before.to_owned() + after.split_once('"').map_or("", |(_, rest)| rest)
                }
                None => own,
            };
            writeln!(all, "<figure>\n{own}><use href=\"#{ID}\"/></svg>\n</figure>")
        };
    }
    all
}

/// Blank about a strip, mm.
const BLANK: f64 = 1.0;
/// The name of the drawing on the page.
const ID: &str = "overlay";

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
    /// About how much of a printed page the report leaves to its figure, mm, in a wide typeface.
    pub(super) fn leaves_of_page(&self) -> f64 {
        /// Between the margins.
        const PAGE: (f64, f64) = (180.0, 266.0);
        /// Title, head of the table and sum; the student's name; what the estimate may miss.
        const HEADS: f64 = 18.0;
        const NAME: f64 = 6.0;
        const MISSED: f64 = 4.0;
        /// A sign and a line of the table, of what is said of faults and of the tolerances.
        const TABLE: (f64, f64) = (1.65, 4.0);
        const SAID: (f64, f64) = (1.9, 4.4);
        const TOLERANCES: (f64, f64) = (1.4, 3.8);
        /// Between two rows of the table, and about a paragraph.
        const GAP: f64 = 0.9;
        let count = |phrase: &Phrase| phrase.told(self.language).chars().count();
        let lines = |signs: usize, room: f64, sign: f64| (signs as f64 * sign / room).ceil().max(1.0);
        let paragraph = |signs: usize, (sign, line): (f64, f64)| lines(signs, PAGE.0, sign) * line;
        // A column is as wide as its longest text, or takes its part of what there is; names are not broken.
        let cells: Vec<[usize; 4]> = self
            .quantities
            .iter()
            .map(|graded| {
                let right = if graded.right.is_empty() { 0 } else { count(&graded.expected_within()) };
                [graded.name.chars().count(), count(&graded.handed_in()), right, count(&graded.judged())]
            })
            .collect();
        let widest = |column: usize| cells.iter().map(|row| row[column]).max().unwrap_or(0) as f64 * TABLE.0;
        // Marks, and the blanks between columns.
        let room = PAGE.0 - widest(0) - 26.0;
        // Numbers that are short are not broken.
        let kept = if self.has_short_numbers() { widest(1) + widest(2) } else { 0.0 };
        let first = if kept > 0.0 { 3 } else { 1 };
        let wanted: f64 = (first..4).map(widest).sum();
        let part = ((room - kept) / wanted.max(1.0)).min(1.0);
        let row = |row: &[usize; 4]| {
            let high = (first..4).map(|column| lines(row[column], (part * widest(column)).max(1.0), TABLE.0));
            GAP + high.fold(1.0, f64::max) * TABLE.1
        };
        let rows: f64 = cells.iter().map(row).sum();
        let unread = self.not_read.iter().map(|one| one.why.to_string().chars().count() + 20);
        let missing = (!self.missing.is_empty()).then(|| self.names_of_missing().chars().count());
        let more: f64 = unread.chain(missing).map(|signs| GAP + paragraph(signs, TABLE)).sum();
        let notes: f64 = self.notes().iter().map(|note| 8.0 * GAP + paragraph(count(note), SAID)).sum();
        let wrong = self.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong);
        let wrong =
            wrong.map(|graded| paragraph(count(&sentence(graded)) + graded.name.chars().count(), SAID));
        let because = 5.0 * GAP + paragraph(self.reasons().chars().count() + 32, TOLERANCES);
        let name = if self.student.is_some() { NAME } else { 0.0 };
        PAGE.1 - HEADS - name - MISSED - rows - more - notes - wrong.sum::<f64>() - because
    }

    /// Whether names and numbers of the table leave enough of a line for what is said of them, so that none needs to be broken.
    fn has_short_numbers(&self) -> bool {
        /// Signs of a line.
        const LINE: usize = 86;
        let count = |phrase: &Phrase| phrase.told(self.language).chars().count();
        let widest = |of: &dyn Fn(&Graded) -> usize| self.quantities.iter().map(of).max().unwrap_or(0);
        let right = |graded: &Graded| match graded.right.is_empty() {
            true => 0,
            false => count(&graded.expected_within()),
        };
        let name = widest(&|graded| graded.name.chars().count());
        name + widest(&|graded| count(&graded.handed_in())) + widest(&right) <= LINE
    }

    /// Why answers may be off by what they may: each reason once, with what it is of.
    fn reasons(&self) -> String {
        let mut read: Vec<String> = Vec::new();
        let mut others: Vec<(String, Vec<&str>)> = Vec::new();
        for graded in &self.quantities {
            if let Allowed::Read { mm: Some(mm), of: Some(of) } = graded.allowed {
                let part = say!("{} of {}", digits(mm, mm / 5.0), digits(of, 1.0));
                read.push(format!("{} {}", graded.name, part.told(self.language)));
                continue;
            }
            let because = graded.because().told(self.language).to_string();
            match others.iter_mut().find(|(known, _)| *known == because) {
                Some((_, of)) => of.push(&graded.name),
                None => others.push((because, vec![&graded.name])),
            }
        }
        let read = (!read.is_empty()).then(|| {
            say!("read off the paper, mm of mm: {}", read.join(", ")).told(self.language).to_string()
        });
        let others = others.into_iter().map(|(because, of)| format!("{}: {because}", of.join(", ")));
        read.into_iter().chain(others).collect::<Vec<_>>().join("; ")
    }

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
        self.to_html_cut(title, overlay, &[])
    }

    /// The same with the overlay cut into strips, each between two heights (mm from the top of the figure), so that a page of paper
    /// may end between any two of them.
    #[must_use]
    pub fn to_html_cut(&self, title: &str, overlay: Option<&str>, strips: &[(f64, f64)]) -> String {
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
        let kind = if self.has_short_numbers() { " class=\"short\"" } else { "" };
        let _ = write!(page, "<table{kind}>\n<tr>");
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
            // Where it stands in the file is the examiner's; the student has its name.
            let why = format!("<bdi>{}</bdi>", escaped(&one.what_and_mend()));
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
        let because = say!("How far an answer may be off: {}.", self.reasons());
        let _ = writeln!(page, "<p><small>{}</small></p>", unit(&self.html(&because)));
        if let Some(svg) = overlay {
            page.push_str(&cut(svg, strips));
        }
        page.push_str("</body>\n</html>\n");
        page
    }
}
