//! A figure as a TikZ picture: compiles alone, and inside a document that loads TikZ and `arrows.meta`.
//!
//! Lengths are true millimetres, y runs up from the lower edge of the page. Every group of the figure is a
//! scope with one style for each of its classes (`linkgram vector`, `linkgram absolute`, …): empty where
//! nothing defines them, so that a document restyles the figure before it inputs it, for instance with
//! `\tikzset{linkgram velocity ink/.style=blue}`. A vector is one path with an arrow tip. Text is set in the
//! document's own type as formulas of LaTeX, drawn to the width that it has on the sheet, so that no label
//! grows into its neighbour; `\newcommand\linkgramfit[2]{#2}` before the picture leaves it as wide as it is.
//! Words of Arabic script, for which plain LaTeX has no letters, are filled outlines, each word defined once; the
//! formulas between them are text.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use kurbo::{PathEl, Point};
use thiserror::Error;

use super::number::decimal;
use super::pages::{self, Page};
use super::theme::{About, Place, Theme};
use crate::sheet::figure::{Dash, Figure, Group, Mark, Node, Pen, Run, Shape, Text, Tone, on_circle};
use crate::sheet::font::Face;

/// TeX knows no length beyond 16 384 pt; this is well inside, mm.
const LARGEST_SIDE: f64 = 5000.0;
/// An arc of a larger radius is drawn as chords, mm.
const LARGEST_RADIUS: f64 = 2000.0;
/// A blank wider than this, per size of the type, parts a line into two pieces.
const APART: f64 = 0.8;
/// Type smaller than this, per size of the line, is a sub- or superscript.
const SCRIPT: f64 = 0.85;
/// Outlined words are defined for type of this size, pt: TeX counts no finer than 1/65536 pt.
const WORD_SIZE: f64 = 10.0;
/// Points of TeX per millimetre.
const POINTS: f64 = 72.27 / 25.4;
/// Widths of strokes that have a name of their own, mm.
const WIDTHS: [(&str, f64); 3] = [("thick", 0.5), ("thin", 0.25), ("fine", 0.18)];

/// Why a figure cannot be written for LaTeX.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TexError {
    /// A character that plain LaTeX has no way to set.
    #[error(
        "plain LaTeX cannot set `{character}` (U+{:04X}) in \"{text}\"; SVG, PNG and PDF can: end the name in .svg, .png or .pdf",
        u32::from(*.character)
    )]
    Character {
        /// The character.
        character: char,
        /// The line in which it stands.
        text: String,
    },
    /// A page larger than TeX's lengths.
    #[error(
        "a page of {width:.0} mm by {height:.0} mm is larger than TeX's lengths allow; choose smaller scales"
    )]
    Size {
        /// mm.
        width: f64,
        /// mm.
        height: f64,
    },
}

/// The figure as a LaTeX file.
///
/// # Errors
/// When its text has characters that plain LaTeX cannot set, or a page is too large.
pub fn write(figure: &Figure, theme: Theme) -> Result<String, TexError> {
    let pages = pages::of(figure);
    if let Some(page) = pages.iter().find(|page| page.width.max(page.height) > LARGEST_SIDE) {
        return Err(TexError::Size { width: page.width, height: page.height });
    }
    let mut pictures = Vec::new();
    let mut styles = BTreeSet::new();
    let mut outlined = Outlined::default();
    for page in &pages {
        let mut picture =
            Picture { page, theme, out: String::new(), styles: &mut styles, outlined: &mut outlined };
        picture.draw()?;
        pictures.push(picture.out);
    }
    let mut out = preamble(figure, theme, &pages, &styles);
    outlined.define(&mut out);
    for (i, picture) in pictures.iter().enumerate() {
        if i > 0 {
            // An empty line: pictures of several pages stand below each other, alone on a page each.
            out.push_str("\\linkgrampagebreak\n\n");
        }
        out.push_str(picture);
    }
    out.push_str("\\linkgramend\n");
    Ok(out)
}

fn preamble(figure: &Figure, theme: Theme, pages: &[Page<'_>], styles: &BTreeSet<String>) -> String {
    let mut out = String::new();
    for line in [&figure.title, &figure.description] {
        let line: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        if !line.is_empty() {
            let _ = writeln!(out, "% {line}");
        }
    }
    let (width, height) = pages.first().map_or((0.0, 0.0), |page| (page.width, page.height));
    let _ = write!(
        out,
        r"% Compile this file by itself, or \input it where \usepackage{{tikz}} and \usetikzlibrary{{arrows.meta}}
% stand in the preamble. Lengths are millimetres; styles are keys that begin with `linkgram`.
\expandafter\ifx\csname tikzpicture\endcsname\relax
  \documentclass{{article}}
  \usepackage{{tikz}}
  \usetikzlibrary{{arrows.meta}}
  \paperwidth={w}mm \paperheight={h}mm
  \csname pdfpagewidth\endcsname=\paperwidth \csname pdfpageheight\endcsname=\paperheight
  \hoffset=-1in \voffset=-1in \oddsidemargin=0pt \topmargin=0pt \headheight=0pt \headsep=0pt
  \textwidth=\paperwidth \textheight=\paperheight \parindent=0pt \topskip=0pt \parskip=0pt
  \hfuzz=1pt \vfuzz=1pt \pagestyle{{empty}}
  \begin{{document}}
  \def\linkgrampagebreak{{\newpage}}
  \def\linkgramend{{\end{{document}}}}
\else
  \def\linkgrampagebreak{{}}
  \def\linkgramend{{}}
\fi
% A style that the document defines already stays as it is.
\providecommand\linkgramstyle[2]{{\pgfkeysifdefined{{/tikz/linkgram #1/.@cmd}}{{}}{{\tikzset{{linkgram #1/.style={{#2}}}}}}}}
% Text of the width #1.
\providecommand\linkgramfit[2]{{\resizebox{{#1}}{{\height}}{{#2}}}}
% Text from (#1) on, of the width #2, in type of the size #3.
\providecommand\linkgramtext[4]{{\node[linkgram text] at (#1) {{\fontsize{{#3}}{{#3}}\selectfont\linkgramfit{{#2}}{{#4}}}};}}
",
        w = decimal(width, 3),
        h = decimal(height, 3),
    );
    for (name, tone, about) in [
        ("ink", Tone::Ink, About::All),
        ("paper", Tone::Paper, About::All),
        ("tint", Tone::Tint, About::All),
        ("velocity", Tone::Ink, About::Velocity),
        ("acceleration", Tone::Ink, About::Acceleration),
    ] {
        let hex = theme.tone(tone, about).hex().to_uppercase();
        let _ = writeln!(out, "\\providecolor{{linkgram{name}}}{{HTML}}{{{hex}}}");
    }
    let old = theme.colour(Tone::Ink, Place::of_the_old()).hex().to_uppercase();
    let _ = writeln!(out, "\\providecolor{{linkgramold}}{{HTML}}{{{old}}}");
    let mut style = |name: &str, value: &str| {
        let _ = writeln!(out, "\\linkgramstyle{{{name}}}{{{value}}}");
    };
    style("picture", "x=1mm, y=1mm, line join=round, color=linkgramink");
    style("text", "anchor=base west, inner sep=0pt, outer sep=0pt, text=linkgramink");
    for (name, width) in WIDTHS {
        style(name, &format!("line width={}mm", decimal(width, 3)));
    }
    for (name, dash) in [("dashed", Dash::Dashed), ("chain", Dash::Chain)] {
        let pattern = dash.lengths().unwrap_or_default().iter().enumerate();
        let pattern = pattern.map(|(i, length)| {
            format!("{} {}mm", if i % 2 == 0 { "on" } else { "off" }, decimal(*length, 3))
        });
        style(name, &format!("dash pattern={}", pattern.collect::<Vec<_>>().join(" ")));
    }
    style("old ink", "color=linkgramold, linkgram text/.append style={text=linkgramold}");
    style("velocity ink", "color=linkgramvelocity");
    style("acceleration ink", "color=linkgramacceleration");
    for name in styles {
        style(name, "");
    }
    out.push_str(
        "% The head of a vector, #1 long and #2 wide.\n\
         \\pgfkeysifdefined{/tikz/linkgram head/.@cmd}{}{\\tikzset{linkgram head/.style 2 args={\
         -{Triangle[length=#1, width=#2, line width=0pt]}}}}\n",
    );
    out
}

/// Words of Arabic script, which are outlines: by face and text, with the number that names them.
#[derive(Debug, Default)]
struct Outlined(BTreeMap<(bool, String), usize>);

impl Outlined {
    fn number(&mut self, run: &Run) -> usize {
        let next = self.0.len() + 1;
        *self.0.entry((run.face == Face::ArabicBold, run.text.trim().to_owned())).or_insert(next)
    }

    /// The outlines of all words, each defined once.
    fn define(&self, out: &mut String) {
        if self.0.is_empty() {
            return;
        }
        out.push_str(
            r"% Outlines of words: to, on, round, and done.
\providecommand\linkgramm[2]{\pgfpathmoveto{\pgfqpoint{#1pt}{#2pt}}}
\providecommand\linkgraml[2]{\pgfpathlineto{\pgfqpoint{#1pt}{#2pt}}}
\providecommand\linkgramc[6]{\pgfpathcurveto{\pgfqpoint{#1pt}{#2pt}}{\pgfqpoint{#3pt}{#4pt}}{\pgfqpoint{#5pt}{#6pt}}}
% The word #3 from (#1) on, #2 times as large as it is defined.
\providecommand\linkgramword[3]{\begin{scope}[shift={(#1)}]\pgftransformscale{#2}\pgfsetfillcolor{linkgramink}%
  \csname linkgram@#3\endcsname\pgfusepathqfill\end{scope}}
",
        );
        let mut all: Vec<_> = self.0.iter().collect();
        all.sort_by_key(|(_, number)| **number);
        for ((bold, text), number) in all {
            let face = if *bold { Face::ArabicBold } else { Face::Arabic };
            let _ = writeln!(out, "% {text}");
            let _ = write!(out, "\\expandafter\\def\\csname linkgram@{number}\\endcsname{{");
            out.push_str(&path_of_word(face, text));
            out.push_str("}\n");
        }
    }
}

fn path_of_word(face: Face, text: &str) -> String {
    let mut out = String::new();
    let at = |p: Point| format!("{{{}}}{{{}}}", decimal(p.x * WORD_SIZE, 3), decimal(-p.y * WORD_SIZE, 3));
    let mut last = Point::ZERO;
    for element in face.outline(text) {
        let _ = match element {
            PathEl::MoveTo(p) => write!(out, "\\linkgramm{}", at(p)),
            PathEl::LineTo(p) => write!(out, "\\linkgraml{}", at(p)),
            // A cubic curve with the same shape.
            PathEl::QuadTo(a, p) => {
                let (b, c) = (last.lerp(a, 2.0 / 3.0), p.lerp(a, 2.0 / 3.0));
                write!(out, "\\linkgramc{}{}{}", at(b), at(c), at(p))
            }
            PathEl::CurveTo(a, b, p) => write!(out, "\\linkgramc{}{}{}", at(a), at(b), at(p)),
            PathEl::ClosePath => writeln!(out, "\\pgfpathclose%"),
        };
        last = element.end_point().unwrap_or(last);
    }
    out
}

struct Picture<'a> {
    page: &'a Page<'a>,
    theme: Theme,
    out: String,
    /// Names of the styles of groups.
    styles: &'a mut BTreeSet<String>,
    /// Words of Arabic script.
    outlined: &'a mut Outlined,
}

impl Picture<'_> {
    fn draw(&mut self) -> Result<(), TexError> {
        let (width, height) = (decimal(self.page.width, 3), decimal(self.page.height, 3));
        self.line("\\begin{tikzpicture}[linkgram picture]");
        self.line(&format!("\\path[use as bounding box] (0,0) rectangle ({width},{height});"));
        if self.theme.paints_paper() {
            self.line(&format!("\\fill[linkgrampaper] (0,0) rectangle ({width},{height});"));
        }
        let page = self.page.group;
        self.children(page, Place::default().inside(page))?;
        self.line("\\end{tikzpicture}%");
        Ok(())
    }

    fn line(&mut self, line: &str) {
        self.out.push_str(line);
        self.out.push('\n');
    }

    fn group(&mut self, group: &Group, around: Place) -> Result<(), TexError> {
        if group.children.is_empty() {
            return Ok(());
        }
        let place = around.inside(group);
        let mut options: Vec<String> = Vec::new();
        for class in group.class.split(' ').filter(|class| !class.is_empty()) {
            self.styles.insert(class.to_owned());
            options.push(format!("linkgram {class}"));
        }
        if place.old != around.old {
            options.push("linkgram old ink".to_owned());
        } else if place.about != around.about && !place.old {
            match place.about {
                About::Velocity => options.push("linkgram velocity ink".to_owned()),
                About::Acceleration => options.push("linkgram acceleration ink".to_owned()),
                About::All => {}
            }
        }
        if options.is_empty() {
            return self.children(group, place);
        }
        self.line(&format!("\\begin{{scope}}[{}]", options.join(", ")));
        self.children(group, place)?;
        self.line("\\end{scope}");
        Ok(())
    }

    fn children(&mut self, group: &Group, place: Place) -> Result<(), TexError> {
        let mut rest = &group.children[..];
        while let Some((first, after)) = rest.split_first() {
            rest = after;
            match first {
                Node::Group(child) => self.group(child, place)?,
                Node::Text(text) => {
                    // Arrows over letters belong to the formula.
                    let over: Vec<&Mark> = after.iter().map_while(over_letter).collect();
                    rest = &after[over.len()..];
                    self.text(text, &over)?;
                }
                Node::Mark(mark) => match after.first() {
                    Some(Node::Mark(head)) if self.arrow(mark, head) => rest = &after[1..],
                    _ => self.mark(mark),
                },
            }
        }
        Ok(())
    }

    fn at(&self, p: Point, precise: bool) -> String {
        let decimals = if precise { 6 } else { 3 };
        let (x, y) = (p.x, self.page.top + self.page.height - p.y);
        format!("({},{})", decimal(x, decimals), decimal(y, decimals))
    }

    /// A straight shaft with its head as one path; `false` where it is none.
    fn arrow(&mut self, shaft: &Mark, head: &Mark) -> bool {
        let (Shape::Line(from, _), Some(pen), Shape::Polygon(corners)) =
            (&shaft.shape, shaft.pen, &head.shape)
        else {
            return false;
        };
        let [tip, one, other] = corners[..] else { return false };
        if shaft.class != "shaft" || head.class != "head" {
            return false;
        }
        let mm = |length: f64| format!("{}mm", decimal(length, 3));
        let size = format!("{{{}}}{{{}}}", mm(tip.distance(one.midpoint(other))), mm(one.distance(other)));
        let style = stroke(pen);
        let (from, tip) = (self.at(*from, shaft.precise), self.at(tip, head.precise));
        self.line(&format!("\\draw[{style}, linkgram head={size}] {from} -- {tip};"));
        true
    }

    fn mark(&mut self, mark: &Mark) {
        let mut options = Vec::new();
        let command = match (mark.pen, mark.fill) {
            (Some(pen), fill) => {
                options.push(stroke(pen));
                if let Some(tone) = fill {
                    options.push(format!("fill={}", tone_name(tone)));
                }
                if fill.is_some() { "filldraw" } else { "draw" }
            }
            (None, Some(tone)) => {
                if tone != Tone::Ink {
                    options.push(tone_name(tone).to_owned());
                }
                "fill"
            }
            (None, None) => return,
        };
        let options = if options.is_empty() { String::new() } else { format!("[{}]", options.join(", ")) };
        let path = self.path(mark);
        self.line(&format!("\\{command}{options} {path};"));
    }

    fn path(&self, mark: &Mark) -> String {
        let at = |p: &Point| self.at(*p, mark.precise);
        let decimals = if mark.precise { 6 } else { 3 };
        let through = |points: &[Point]| points.iter().map(at).collect::<Vec<_>>().join(" -- ");
        let chords = |shape: &Shape| {
            let pieces = shape.outline();
            let points: Vec<Point> =
                pieces.first().map(|(a, _)| *a).into_iter().chain(pieces.iter().map(|(_, b)| *b)).collect();
            through(&points)
        };
        match &mark.shape {
            Shape::Line(a, b) => through(&[*a, *b]),
            Shape::Polyline(points) => through(points),
            Shape::Polygon(points) => format!("{} -- cycle", through(points)),
            Shape::Curve(_) => chords(&mark.shape),
            Shape::Circle { radius, .. } | Shape::Arc { radius, .. } if *radius > LARGEST_RADIUS => {
                chords(&mark.shape)
            }
            Shape::Circle { centre, radius } => {
                format!("{} circle[radius={}mm]", at(centre), decimal(*radius, decimals))
            }
            Shape::Arc { centre, radius, start, sweep } => format!(
                "{} arc[start angle={}, delta angle={}, radius={}mm]",
                at(&on_circle(*centre, *radius, *start)),
                decimal(start.to_degrees(), 4),
                decimal(sweep.to_degrees(), 4),
                decimal(*radius, decimals)
            ),
        }
    }

    fn text(&mut self, text: &Text, over: &[&Mark]) -> Result<(), TexError> {
        let tall = text.runs.iter().map(|run| run.size).fold(0.0, f64::max);
        let mut pieces: Vec<Vec<&Run>> = Vec::new();
        let mut end = f64::NEG_INFINITY;
        for run in &text.runs {
            if run.face.is_arabic() {
                self.word(run);
                end = f64::NEG_INFINITY;
                continue;
            }
            // A line from right to left goes back to where its next piece begins.
            let back =
                pieces.last().and_then(|piece| piece.first()).is_some_and(|first| run.at.x < first.at.x);
            let far = run.at.x - end > APART * tall || back;
            match pieces.last_mut() {
                Some(piece) if !far => piece.push(run),
                _ => pieces.push(vec![run]),
            }
            end = end.max(run.at.x + run.face.advance(&run.text, run.size));
        }
        for piece in pieces {
            self.formula(&piece, over).map_err(|character| TexError::Character {
                character,
                text: text.content().trim().to_owned(),
            })?;
        }
        Ok(())
    }

    /// A word of Arabic script as its outline.
    fn word(&mut self, run: &Run) {
        if run.text.trim().is_empty() {
            return;
        }
        let number = self.outlined.number(run);
        let at = self.at(run.at, false);
        let scale = decimal(run.size * POINTS / WORD_SIZE, 5);
        self.line(&format!("\\linkgramword{{{}}}{{{scale}}}{{{number}}}", at.trim_matches(['(', ')'])));
    }

    /// Runs beside each other as one node.
    fn formula(&mut self, runs: &[&Run], over: &[&Mark]) -> Result<(), char> {
        let size = runs.iter().map(|run| run.size).fold(0.0, f64::max);
        let base = runs.iter().find(|run| run.size > SCRIPT * size).map_or(0.0, |run| run.at.y);
        let start = runs.iter().map(|run| run.at.x).fold(f64::INFINITY, f64::min);
        let end = |run: &&Run| run.at.x + run.face.advance(run.text.trim_end(), run.size);
        let end = runs.iter().map(end).fold(start, f64::max);
        if end <= start {
            return Ok(());
        }
        let mut atoms = Atoms::default();
        for run in runs {
            let primes = !run.text.trim().is_empty() && run.text.trim().chars().all(|c| c == '′' || c == '″');
            if run.size > SCRIPT * size && !primes {
                let has_arrow = over.iter().any(|arrow| {
                    let middle = arrow.bounds().center().x;
                    middle > run.at.x
                        && middle < run.at.x + run.face.advance(&run.text, run.size) + 0.1 * size
                });
                atoms.base(&run.text, run.face, has_arrow)?;
            } else {
                atoms.script(&run.text, run.face, primes || run.at.y < base)?;
            }
        }
        let at = self.at(Point::new(start, base), false);
        let at = at.trim_matches(['(', ')']);
        let (width, size) = (decimal(end - start, 3), decimal(size, 3));
        let tex = atoms.finish();
        self.line(&format!("\\linkgramtext{{{at}}}{{{width}mm}}{{{size}mm}}{{{tex}}}"));
        Ok(())
    }
}

fn over_letter(node: &Node) -> Option<&Mark> {
    match node {
        Node::Mark(mark) if mark.class == "arrow-over" => Some(mark),
        _ => None,
    }
}

fn stroke(pen: Pen) -> String {
    let named = WIDTHS.iter().find(|(_, width)| *width == pen.width);
    let width = match named {
        Some((name, _)) => format!("linkgram {name}"),
        None => format!("line width={}mm", decimal(pen.width, 3)),
    };
    match pen.dash {
        Dash::Solid => width,
        Dash::Dashed => format!("{width}, linkgram dashed"),
        Dash::Chain => format!("{width}, linkgram chain"),
        Dash::Dotted => format!("{width}, densely dotted"),
    }
}

const fn tone_name(tone: Tone) -> &'static str {
    match tone {
        Tone::Ink => "linkgramink",
        Tone::Paper => "linkgrampaper",
        Tone::Tint => "linkgramtint",
    }
}

/// A line of text in LaTeX, taken up run by run.
#[derive(Debug, Default)]
struct Atoms(Vec<Atom>);

/// Words, or a formula with what depends on its end.
#[derive(Debug)]
enum Atom {
    Words(String),
    Formula { base: String, sup: String, sub: String },
}

impl Atoms {
    fn words(&mut self, words: &str) {
        match self.0.last_mut() {
            Some(Atom::Words(before)) => before.push_str(words),
            _ if words.is_empty() => {}
            _ => self.0.push(Atom::Words(words.to_owned())),
        }
    }

    fn formula(&mut self, base: String) {
        self.0.push(Atom::Formula { base, sup: String::new(), sub: String::new() });
    }

    /// Characters on the base line.
    fn base(&mut self, text: &str, face: Face, arrow: bool) -> Result<(), char> {
        let trimmed = text.trim_end_matches(' ');
        if arrow {
            self.formula(format!("\\vec{{{}}}", math(trimmed, false)?.trim_end()));
        } else if face == Face::Italic {
            self.italic(trimmed)?;
        } else if face == Face::Bold {
            let words = words(trimmed)?;
            self.words(&format!("\\textbf{{{words}}}"));
        } else {
            let words = words(trimmed)?;
            self.words(&words);
        }
        if trimmed.len() < text.len() {
            self.words(" ");
        }
        Ok(())
    }

    /// Italic words, the last of which is a quantity: it may carry scripts.
    fn italic(&mut self, text: &str) -> Result<(), char> {
        let quantity = |c: char| c.is_alphanumeric() || c == '′';
        let from = text.char_indices().rev().take_while(|(_, c)| quantity(*c)).last();
        let (before, last) = text.split_at(from.map_or(text.len(), |(i, _)| i));
        if !before.is_empty() {
            let words = words(before)?;
            self.words(&format!("\\textit{{{words}}}"));
        }
        let letters = last.trim_end_matches('′');
        if !last.is_empty() {
            self.formula(math(letters, false)?);
            // Primes are superscripts: another may follow, and LaTeX takes only one.
            self.script(&last[letters.len()..], Face::Italic, true)?;
        }
        Ok(())
    }

    /// Characters above or below the base line, at the end of what stands there.
    fn script(&mut self, text: &str, face: Face, above: bool) -> Result<(), char> {
        let trimmed = text.trim_end_matches(' ');
        let set = math(trimmed, face != Face::Italic)?;
        if !matches!(self.0.last(), Some(Atom::Formula { .. })) {
            self.formula(String::new());
        }
        if let Some(Atom::Formula { sup, sub, .. }) = self.0.last_mut() {
            if above { sup.push_str(&set) } else { sub.push_str(&set) }
        }
        if trimmed.len() < text.len() {
            self.words(" ");
        }
        Ok(())
    }

    fn finish(self) -> String {
        let mut out = String::new();
        let mut inside = false;
        for atom in self.0 {
            match atom {
                Atom::Words(words) => {
                    if std::mem::take(&mut inside) {
                        out.push('$');
                    }
                    out.push_str(&words);
                }
                Atom::Formula { base, sup, sub } => {
                    if !std::mem::replace(&mut inside, true) {
                        out.push('$');
                    }
                    out.push_str(if base.is_empty() { "{}" } else { base.trim_end() });
                    let primes = sup.matches(PRIME).count();
                    if primes * PRIME.len() == sup.len() {
                        out.extend(std::iter::repeat_n('\'', primes));
                    } else {
                        let _ = write!(out, "^{{{}}}", sup.trim_end());
                    }
                    if !sub.is_empty() {
                        let _ = write!(out, "_{{{}}}", sub.trim_end());
                    }
                }
            }
        }
        if inside {
            out.push('$');
        }
        out
    }
}

/// Letters of Latin languages that LaTeX sets in its own type by accents and ligatures.
const LATIN: &str =
    "ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÑÒÓÔÕÖØÙÚÛÜÝßàáâãäåæçèéêëìíîïñòóôõöøùúûüýÿŒœŠšŽžČčĆćĎďĚěŇňŘřŤťŮůŁłŃńŚśŹźŻżŐőŰűĞğİıŞş";

/// A prime as part of a superscript.
const PRIME: &str = "\\prime ";

/// The macro of a sign or a Greek letter in a formula.
fn sign(c: char) -> Option<&'static str> {
    Some(match c {
        '−' => "-",
        '⊥' => "\\perp",
        '∥' => "\\parallel",
        '≡' => "\\equiv",
        '≙' => "\\mathrel{\\widehat{=}}",
        '∠' => "\\angle",
        '≈' => "\\approx",
        '≠' => "\\neq",
        '≤' => "\\le",
        '≥' => "\\ge",
        '±' => "\\pm",
        '×' => "\\times",
        '·' => "\\cdot",
        '→' => "\\to",
        '∞' => "\\infty",
        '∼' => "\\sim",
        '°' => "{}^\\circ",
        '²' => "{}^2",
        '³' => "{}^3",
        '¹' => "{}^1",
        'μ' | 'µ' => "\\mu",
        'α' => "\\alpha",
        'β' => "\\beta",
        'γ' => "\\gamma",
        'δ' => "\\delta",
        'ε' => "\\varepsilon",
        'ζ' => "\\zeta",
        'η' => "\\eta",
        'θ' => "\\theta",
        'κ' => "\\kappa",
        'λ' => "\\lambda",
        'ν' => "\\nu",
        'ξ' => "\\xi",
        'π' => "\\pi",
        'ρ' => "\\rho",
        'σ' => "\\sigma",
        'τ' => "\\tau",
        'φ' => "\\varphi",
        'χ' => "\\chi",
        'ψ' => "\\psi",
        'ω' => "\\omega",
        'Γ' => "\\Gamma",
        'Δ' => "\\Delta",
        'Θ' => "\\Theta",
        'Λ' => "\\Lambda",
        'Π' => "\\Pi",
        'Σ' => "\\Sigma",
        'Φ' => "\\Phi",
        'Ψ' => "\\Psi",
        'Ω' => "\\Omega",
        _ => return None,
    })
}

/// A character of running text; `None` where LaTeX has none.
fn character(c: char) -> Option<String> {
    Some(match c {
        '\\' => "\\textbackslash{}".to_owned(),
        '{' | '}' | '$' | '&' | '#' | '_' | '%' => format!("\\{c}"),
        '^' => "\\^{}".to_owned(),
        '~' => "\\~{}".to_owned(),
        '<' | '>' | '|' => format!("${c}$"),
        '"' => "''".to_owned(),
        ' '..='\u{7e}' => c.to_string(),
        '\u{a0}' => "~".to_owned(),
        '\u{2002}' => "\\enspace{}".to_owned(),
        '\u{2003}' => "\\quad{}".to_owned(),
        '\u{2009}' | '\u{202f}' => "\\,".to_owned(),
        '–' => "--".to_owned(),
        '—' => "---".to_owned(),
        '‘' => "`".to_owned(),
        '’' => "'".to_owned(),
        '“' => "``".to_owned(),
        '”' => "''".to_owned(),
        '…' => "\\dots{}".to_owned(),
        '′' => "$'$".to_owned(),
        '″' => "$''$".to_owned(),
        c if LATIN.contains(c) => c.to_string(),
        c => format!("${}$", sign(c)?),
    })
}

fn words(text: &str) -> Result<String, char> {
    text.chars().map(|c| character(c).ok_or(c)).collect()
}

/// Characters of a formula: upright or italic letters, signs, Greek.
fn math(text: &str, upright: bool) -> Result<String, char> {
    let mut out = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let run = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        if run > 0 {
            let letters = &rest[..run];
            let digits = letters.bytes().all(|b| b.is_ascii_digit());
            if digits || (letters.len() == 1 && !upright) {
                out.push_str(letters);
            } else {
                let _ = write!(out, "\\{}{{{letters}}}", if upright { "mathrm" } else { "mathit" });
            }
            rest = &rest[run..];
            continue;
        }
        match c {
            '′' => out.push_str(PRIME),
            '″' => out.extend([PRIME, PRIME]),
            ',' | '.' | ';' | ':' | '/' | '(' | ')' | '+' | '=' | '[' | ']' | '!' | '?' | '*' => out.push(c),
            '-' => out.push_str("\\mbox{-}"),
            ' ' | '\u{a0}' => out.push_str("\\ "),
            c => match sign(c) {
                Some(sign) => {
                    out.push_str(sign);
                    out.push(' ');
                }
                None => {
                    let _ = write!(out, "\\mbox{{{}}}", character(c).ok_or(c)?);
                }
            },
        }
        rest = &rest[c.len_utf8()..];
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::figure::Group;

    fn run(text: &str, face: Face, size: f64, x: f64, y: f64) -> Run {
        Run { text: text.to_owned(), face, size, at: Point::new(x, y) }
    }

    fn figure(runs: Vec<Run>) -> Figure {
        let mut root = Group::new("skeleton");
        root.text(Text { class: "label", runs });
        Figure {
            width: 50.0,
            height: 20.0,
            title: "x".to_owned(),
            description: String::new(),
            language: "en",
            root,
        }
    }

    #[test]
    fn quantities_are_formulas_and_units_are_words() {
        let runs = vec![
            run("A", Face::Italic, 4.0, 1.0, 10.0),
            run("n", Face::Upright, 2.8, 3.7, 8.5),
            run("BA ", Face::Upright, 2.8, 3.6, 10.8),
            run("= 15 cm/s² ", Face::Upright, 4.0, 7.5, 10.0),
            run("ω", Face::Italic, 4.0, 25.0, 10.0),
            run("2", Face::Upright, 2.8, 27.4, 10.8),
        ];
        let tex = write(&figure(runs), Theme::Mono).unwrap();
        let line = tex.lines().find(|l| l.starts_with("\\linkgramtext{")).unwrap();
        assert!(line.starts_with("\\linkgramtext{1,10}"), "{line}");
        assert!(
            line.ends_with("{4mm}{$A^{\\mathrm{n}}_{\\mathrm{BA}}$ = 15 cm/s${}^2$ $\\omega_{2}$}"),
            "{line}"
        );
    }

    #[test]
    fn what_latex_gives_a_meaning_is_escaped() {
        let tex = write(&figure(vec![run("50 % of $x_1 & \\y", Face::Upright, 4.0, 1.0, 10.0)]), Theme::Mono);
        assert!(tex.unwrap().contains("{50 \\% of \\$x\\_1 \\& \\textbackslash{}y}"));
    }

    #[test]
    fn what_latex_cannot_set_is_refused_with_the_formats_that_can() {
        let error = write(&figure(vec![run("ש", Face::Upright, 4.0, 1.0, 10.0)]), Theme::Mono).unwrap_err();
        let message = error.to_string();
        assert!(message.contains("U+05E9") && message.contains(".pdf"), "{message}");
    }
}
