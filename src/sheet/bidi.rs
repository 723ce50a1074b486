//! Lines in which words of Arabic script and formulas stand side by side.
//!
//! Viewers order such a line by rules of their own and not all alike, so nothing is left to them: each word
//! of Arabic script, each formula and each sign between them becomes a run of its own at its own place, and
//! no run has two directions in it. The rules are those of the Unicode bidirectional algorithm as far as a
//! sheet needs them: formulas that fill a sentence are isolates, signs between two pieces of one direction
//! follow them, all others follow the line, and brackets that follow a line from right to left are
//! mirrored.

use kurbo::{Point, Vec2};

use super::figure::Run;
use super::font::{Face, is_arabic, is_arabic_digit};
use super::rich::{Item, Piece, Setter};

/// Size of Arabic script beside Latin of size 1: its letters are lower in their em.
const ARABIC: f64 = 1.12;

/// The mark that stands for a letter of Arabic script and is not printed.
const RIGHT_TO_LEFT: char = '\u{200f}';

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Left,
    Right,
    /// As its neighbours run.
    Neutral,
}

/// Characters of one kind, or a piece of a formula.
#[derive(Debug, Clone)]
struct Fragment {
    piece: Piece,
    way: Way,
}

/// Sets a line; `right` where the line as a whole runs from right to left.
pub(super) fn set(items: &[Item], right: bool, size: f64) -> Setter {
    let base = if right { Way::Right } else { Way::Left };
    let mut fragments = fragments(items);
    resolve(&mut fragments, base);
    let segments = fragments.chunk_by(|a, b| a.way == b.way).map(|segment| match segment.first() {
        Some(Fragment { way: Way::Right, .. }) => leftward(segment, size),
        _ => rightward(segment, size),
    });
    let segments: Vec<Setter> = segments.collect();
    let mut line = Setter::new(size);
    line.pen = segments.iter().map(|s| s.pen).sum();
    let mut x = if right { line.pen } else { 0.0 };
    for mut segment in segments {
        if right {
            x -= segment.pen;
        }
        let by = Vec2::new(x, 0.0);
        segment.runs.iter_mut().for_each(|run| run.at += by);
        segment.marks.iter_mut().for_each(|mark| mark.shape.translate(by));
        line.runs.append(&mut segment.runs);
        line.marks.append(&mut segment.marks);
        if !right {
            x += segment.pen;
        }
    }
    line
}

fn fragments(items: &[Item]) -> Vec<Fragment> {
    let mut all: Vec<Fragment> = Vec::new();
    for item in items {
        match &item.piece {
            piece if item.island => all.push(Fragment { piece: piece.clone(), way: Way::Left }),
            Piece::Run(text, face) => {
                for c in text.chars() {
                    // What follows this mark belongs to the line, even between two formulas.
                    if c == RIGHT_TO_LEFT {
                        all.push(Fragment { piece: Piece::Gap(0.0), way: Way::Right });
                        continue;
                    }
                    let way = way(c);
                    match all.last_mut() {
                        Some(Fragment { piece: Piece::Run(run, last), way: same })
                            if *last == *face && *same == way && joins(run, c) =>
                        {
                            run.push(c);
                        }
                        _ => all.push(Fragment { piece: Piece::Run(c.to_string(), *face), way }),
                    }
                }
            }
            Piece::Gap(_) => all.push(Fragment { piece: item.piece.clone(), way: Way::Neutral }),
            piece => all.push(Fragment { piece: piece.clone(), way: Way::Left }),
        }
    }
    all
}

/// Whether a character may stand in one run with those before it: signs of Arabic script stand alone, or a
/// viewer would move one from the end of a run to its other end.
fn joins(run: &str, c: char) -> bool {
    !is_sign(c) && !run.ends_with(is_sign) && !is_bracket(c) && !run.ends_with(is_bracket)
}

fn is_bracket(c: char) -> bool {
    matches!(c, '(' | ')' | '[' | ']' | '{' | '}')
}

fn is_sign(c: char) -> bool {
    matches!(c, '،' | '؛' | '؟' | '٪')
}

fn way(c: char) -> Way {
    if is_arabic_digit(c) {
        Way::Left
    } else if is_arabic(c) {
        Way::Right
    } else if c.is_whitespace() || ".,:;!?()[]{}«»–—·\"'…".contains(c) {
        Way::Neutral
    } else {
        Way::Left
    }
}

/// Brackets around a formula, after a formula, belong to it. In a line from right to left all others belong to the line, both
/// of a pair: else what stands on one side only of them would take one of them away.
fn bracket(fragments: &mut [Fragment], base: Way) {
    let sign = |f: &Fragment| match &f.piece {
        Piece::Run(text, _) if f.way == Way::Neutral => text.chars().next(),
        _ => None,
    };
    let mut open = Vec::new();
    for at in 0..fragments.len() {
        match sign(&fragments[at]) {
            Some('(' | '[' | '{') => open.push(at),
            Some(')' | ']' | '}') => {
                let Some(from) = open.pop() else { continue };
                let before = fragments[..from].iter().rev().find(|f| f.way != Way::Neutral);
                let inside = fragments[from..at].iter().all(|f| f.way != Way::Right);
                let way = if inside && before.is_some_and(|f| f.way == Way::Left) { Way::Left } else { base };
                if way == Way::Left && !inside {
                    continue;
                }
                fragments[from].way = way;
                fragments[at].way = way;
            }
            _ => {}
        }
    }
}

/// What is neutral runs as both its neighbours do where they agree, else as the line.
fn resolve(fragments: &mut [Fragment], base: Way) {
    bracket(fragments, base);
    let mut before = base;
    let mut from = 0;
    while from < fragments.len() {
        if fragments[from].way != Way::Neutral {
            before = fragments[from].way;
            from += 1;
            continue;
        }
        let length = fragments[from..].iter().take_while(|f| f.way == Way::Neutral).count();
        let after = fragments.get(from + length).map_or(base, |f| f.way);
        let way = if before == after { before } else { base };
        fragments[from..from + length].iter_mut().for_each(|f| f.way = way);
        from += length;
    }
}

/// A formula: as it always is.
fn rightward(segment: &[Fragment], size: f64) -> Setter {
    let mut pieces: Vec<Piece> = Vec::new();
    for Fragment { piece, .. } in segment {
        match (pieces.last_mut(), piece) {
            (Some(Piece::Run(run, last)), Piece::Run(text, face)) if *last == *face => run.push_str(text),
            _ => pieces.push(piece.clone()),
        }
    }
    let mut setter = Setter::new(size);
    for piece in &pieces {
        match piece {
            // A number in Arabic digits.
            Piece::Run(text, face) if face.is_arabic() => {
                let at = Point::new(setter.pen, 0.0);
                let size = size * ARABIC;
                setter.pen += face.advance(text, size);
                setter.runs.push(Run { text: text.clone(), face: *face, size, at });
            }
            piece => setter.piece(piece),
        }
    }
    setter
}

/// Words from right to left.
fn leftward(segment: &[Fragment], size: f64) -> Setter {
    let mut line = Leftward { size, x: 0.0, runs: Vec::new(), word: None, blanks: 0 };
    for fragment in segment {
        match &fragment.piece {
            Piece::Run(text, face) => text.chars().for_each(|c| line.character(c, *face)),
            Piece::Gap(em) => {
                line.flush();
                line.x -= em * size;
            }
            // Formulas run from left to right.
            Piece::Vector(_) | Piece::Scripts { .. } | Piece::Tick => {}
        }
    }
    line.flush();
    let mut setter = Setter::new(size);
    setter.pen = -line.x;
    line.runs.iter_mut().for_each(|run| run.at.x -= line.x);
    setter.runs = line.runs;
    setter
}

/// A line that grows to the left of x = 0.
struct Leftward {
    size: f64,
    x: f64,
    runs: Vec<Run>,
    /// Words with plain blanks between them: one run.
    word: Option<(String, Face)>,
    blanks: usize,
}

impl Leftward {
    fn character(&mut self, c: char, face: Face) {
        if c == ' ' {
            self.blanks += 1;
        } else if way(c) == Way::Right && !is_sign(c) {
            if let Some((word, own)) = &mut self.word
                && *own == face
            {
                word.extend(std::iter::repeat_n(' ', self.blanks));
                word.push(c);
                self.blanks = 0;
            } else {
                self.flush();
                self.word = Some((c.to_string(), face));
            }
        } else if c.is_whitespace() {
            self.flush();
            self.x -= Face::Upright.advance(&c.to_string(), self.size);
        } else {
            self.flush();
            let size = if face.is_arabic() { self.size * ARABIC } else { self.size };
            self.put(mirrored(c).to_string(), face, size);
        }
    }

    fn flush(&mut self) {
        let mut blank = Face::Upright.advance(" ", self.size);
        if let Some((word, face)) = self.word.take() {
            // A word stands as far from a formula as from another word.
            blank = blank.max(face.advance(" ", self.size * ARABIC));
            self.put(word, face, self.size * ARABIC);
        }
        self.x -= blank * self.blanks as f64;
        self.blanks = 0;
    }

    fn put(&mut self, text: String, face: Face, size: f64) {
        self.x -= face.advance(&text, size);
        self.runs.push(Run { text, face, size, at: Point::new(self.x, 0.0) });
    }
}

/// A bracket as it stands in a line from right to left.
fn mirrored(c: char) -> char {
    match c {
        '(' => ')',
        ')' => '(',
        '[' => ']',
        ']' => '[',
        '{' => '}',
        '}' => '{',
        '«' => '»',
        '»' => '«',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::rich::Rich;

    /// The runs of a line from left to right.
    fn seen(text: &Rich) -> Vec<String> {
        let mut runs = text.set(4.0).text.runs;
        runs.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
        runs.into_iter().map(|run| run.text.trim().to_owned()).collect()
    }

    #[test]
    fn a_sentence_runs_from_right_to_left_around_its_formulas() {
        let length = Rich::upright("AB = 45 cm (45.0 mm)");
        let sentence =
            Rich::fill("ارسم {length} من {point}.", &[("length", length), ("point", Rich::italic("A"))]);
        assert_eq!(seen(&sentence), [".", "A", "من", "AB = 45 cm (45.0 mm)", "ارسم"]);
    }

    #[test]
    fn lists_run_like_their_line_and_brackets_are_mirrored() {
        let list = Rich::join(&[Rich::upright("3"), Rich::upright("4")], &Rich::upright("، "));
        assert_eq!(seen(&list), ["4", "،", "3"]);
        let formula = Rich::fill(
            "طول {l} = {v} ({mm}) هنا",
            &[("l", Rich::italic("AB")), ("v", Rich::upright("4 cm")), ("mm", Rich::upright("2 mm"))],
        );
        assert_eq!(seen(&formula), ["هنا", "AB", "= 4 cm (2 mm)", "طول"]);
        let bracketed = Rich::upright("وصلة (إطار) 3-1: نص");
        assert_eq!(seen(&bracketed), ["نص", ":", "3-1", "(", "إطار", ")", "وصلة"]);
    }

    #[test]
    fn the_runs_fill_the_line_and_no_two_overlap() {
        let text = Rich::fill(
            "مخطط {v} (نص) {w}",
            &[("v", Rich::italic("V").sub("BA")), ("w", Rich::upright("5 cm"))],
        );
        let line = text.set(4.0);
        assert!((line.width - text.width(4.0)).abs() < 1e-9);
        let words: Vec<_> = line.text.runs.iter().filter(|run| run.face.is_arabic()).collect();
        for word in &words {
            let own = word.bounds().unwrap();
            assert!(own.x0 > -0.3 && own.x1 < line.width + 0.3);
            let others = line.text.runs.iter().filter(|run| *run != *word).filter_map(Run::bounds);
            assert!(others.into_iter().all(|b| own.intersect(b).is_zero_area()));
        }
    }

    #[test]
    fn a_foreign_word_in_a_latin_title_leaves_it_as_it_is() {
        let title = Rich::written("Problem (مسألة) 3", Face::Bold);
        assert_eq!(seen(&title), ["Problem (", "مسألة", ") 3"]);
    }

    /// As the Unicode bidirectional algorithm has it (rule N0): both brackets of a pair run the same way.
    #[test]
    fn no_bracket_leaves_its_pair() {
        assert_eq!(seen(&Rich::upright("وصلة (3) AB نص")), ["نص", "AB", "(", "3", ")", "وصلة"]);
        assert_eq!(seen(&Rich::upright("(3) AB = 4 cm نص")), ["نص", "AB = 4 cm", "(", "3", ")"]);
    }

    /// A list of pairs in a sentence is read from left to right on every line of it, its pairs whole or broken only between.
    #[test]
    fn pairs_of_a_curve_keep_their_brackets() {
        let knots = [[0.0, 2.0], [1.0, 3.0], [2.0, 5.0], [3.0, 4.0], [4.0, 1.0]];
        let exact = |at: [f64; 2]| at.map(crate::given::Given::exact);
        let curve = crate::mechanism::curve::Curve::Table {
            knots: knots.map(exact).to_vec(),
            period: crate::given::Given::exact(5.0),
        };
        let unit = crate::mechanism::quantity::Unit { symbol: "MPa".to_owned(), si: 1.0 };
        let text = Rich::upright("الضغط ").then(&crate::sheet::cycle::of_curve(&curve, &unit)).up("، نص");
        let lines = text.wrap(4.0, 40.0);
        assert!(lines.len() > 2);
        for line in lines {
            let told = seen(&line).join(" ");
            let mut depth = 0;
            for c in told.chars() {
                depth += match c {
                    '(' => 1,
                    ')' => -1,
                    _ => 0,
                };
                assert!((0..=1).contains(&depth), "{told}");
            }
            assert_eq!(depth, 0, "{told}");
        }
    }

    #[test]
    fn a_formula_among_arabic_sentences_ends_with_its_stop_on_the_left() {
        let formula = Rich::italic("F").sub("34").up(" = −(").it("F").up(" + 2) / 3.");
        let told = seen(&formula.among_right_to_left());
        assert_eq!(told.first().map(String::as_str), Some("."), "{told:?}");
        assert_eq!(told[1..].concat(), "F34= −(F+ 2) / 3", "{told:?}");
        let bare = Rich::italic("F").up(" = 3 N");
        assert_eq!(bare.among_right_to_left(), bare);
    }

    #[test]
    fn a_long_formula_broken_over_lines_stays_an_island() {
        let formula = Rich::upright("A = 2 × 3 = 6 (six) and so on for ever");
        let text = Rich::fill("الناتج {f} نهاية", &[("f", formula)]);
        let words: Vec<Vec<String>> = text.wrap(4.0, 40.0).iter().map(seen).collect();
        assert!(words.len() > 1);
        assert!(words.iter().flatten().all(|run| !run.contains("(") || run.contains("(six)")), "{words:?}");
    }
}
