//! What is said of a step, with the numbers of every position.
//!
//! The sheet says the same step at some positions of the course. A number that is printed differently there is bound to
//! the output that is printed so in all of them, to the last figure; a sentence of which one number is bound to nothing,
//! or whose words differ, is said of the scene's own position only. A number that is the product or the quotient of those before
//! it in its line, as they are printed, is calculated from these everywhere: what was read off paper is rounded, and no output is
//! so to the last figure. So nothing here knows what a sentence means.
//!
//! A sentence that lays a vector off, or reads it, has other words where that is a point on paper: it is told in all of them, and
//! the page takes those of the position.

use serde_json::{Value, json};

use crate::graphical::is_a_point;
use crate::mechanism::quantity::Quantity;
use crate::sheet::moving::{self, Lengths, Said, Sentence};
use crate::sweep::Sweep;

/// The name of what is said everywhere but at the scene's own position.
const ELSEWHERE: &str = "elsewhere";

/// More figures than this no factor of a line has.
const GUARDS: usize = 4;

/// Whether two texts say the same but for numbers and senses.
fn alike(one: &[Token], other: &[Token]) -> bool {
    let same = |(one, other): (&Token, &Token)| match (one, other) {
        (Token::Words(one), Token::Words(other)) => one == other,
        _ => std::mem::discriminant(one) == std::mem::discriminant(other),
    };
    one.len() == other.len() && one.iter().zip(other).all(same)
}

/// A piece of a text.
#[derive(Debug, Clone, PartialEq)]
enum Token {
    Words(String),
    Number(String),
    /// A word for a sense of rotation.
    Sense(String),
}

/// How a number is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    /// The size of an output.
    Size,
    /// An output with its sign.
    Signed,
    /// The length of a vector.
    Length,
    /// The same on the paper of a polygon, in millimetres.
    OnPaper,
    /// The direction of a vector.
    Direction,
    /// What is varied.
    Input,
    /// How far two places are from each other on the paper of the skeleton, in millimetres.
    Between,
}

impl Form {
    const fn code(self) -> u32 {
        match self {
            Self::Size => 0,
            Self::Signed => 1,
            Self::Length => 2,
            Self::OnPaper => 3,
            Self::Direction => 4,
            Self::Input => 5,
            Self::Between => 10,
        }
    }
}

/// A number that can be printed in every position: what it is of, and its value in each of those that were drawn.
#[derive(Debug, Clone)]
struct Candidate {
    form: Form,
    output: usize,
    /// SI units of a unit, or of a millimetre.
    si: f64,
    /// The panel on whose paper it is; of a distance the output of the other place.
    panel: Option<usize>,
    values: Vec<f64>,
}

/// A panel, its SI units for a millimetre, and whether a quantity is drawn on its paper.
pub(super) type Paper<'a> = (usize, f64, &'a dyn Fn(Quantity) -> bool);

/// The length of a vector on the paper of a panel.
#[derive(Debug, Clone, Copy)]
struct OnPaper {
    panel: usize,
    si_per_mm: f64,
    output: usize,
}

/// A length that is read off a paper in a text: its piece, and how it is printed in the positions.
struct Reading<'a> {
    on: OnPaper,
    piece: usize,
    printed: Vec<&'a str>,
    /// SI units of the unit of what is read, once the scale by which it is multiplied has stood there.
    si: Option<f64>,
}

/// The code of a number that is read off a paper, with its amount; of the amount, and of the scale between them.
const READ: u32 = 9;
const AMOUNT: u32 = 7;
const FACTOR: u32 = 8;
/// The code of a number that is calculated from printed ones: its index and, where it is first told, factors, divisors, and how many
/// figures more than usual it has elsewhere and at the scene's own position.
const CALCULATED: u32 = 11;
/// The code of a number that is the same everywhere: as it is printed at the scene's own position, and elsewhere.
const ONE_NUMBER: u32 = 12;

/// What is no point on paper is a millimetre long and read to half a tenth: so far off is what follows from it.
const AS_READ: f64 = 0.05;

/// What lines have told.
#[derive(Debug, Default)]
struct Calculated {
    /// The numbers that they have calculated, as they are printed in the positions; their index is their number.
    numbers: Vec<Vec<String>>,
    /// The outputs that they have read off paper.
    read: Vec<usize>,
}

impl Calculated {
    /// The number that is printed so, if it was told before.
    fn told(&self, printed: &[&str], at: &[usize]) -> Option<Value> {
        let is_told = |all: &Vec<String>| at.iter().zip(printed).all(|(index, text)| all[*index] == *text);
        Some(json!([CALCULATED, self.numbers.iter().position(is_told)?]))
    }
}

/// A printed number, its power of ten with it.
fn value_of(text: &str) -> Option<f64> {
    text.replace("\u{a0}×\u{a0}10<sup>", "e")
        .replace("</sup>", "")
        .replace('\u{2009}', "")
        .replace('−', "-")
        .parse()
        .ok()
}

/// A number that is the same in every position and is printed with more figures in some, as lines need them: as it is printed
/// at the scene's own position, and with the most of them.
fn one_number(printed: &[&str], has_own: bool) -> Option<Value> {
    let figures = |text: &str| {
        text.chars().filter(char::is_ascii_digit).collect::<String>().trim_start_matches('0').len()
    };
    let longest = *printed.iter().max_by_key(|text| figures(text))?;
    let value = value_of(longest)?;
    let is_rounded = |text: &&str| {
        let digits = figures(text).max(1);
        let to = format!("{value:.*e}", digits - 1).parse::<f64>().ok();
        to.zip(value_of(text)).is_some_and(|(to, own)| (to - own).abs() <= 1e-9 * own.abs())
    };
    if !printed.iter().all(is_rounded) {
        return None;
    }
    Some(json!([ONE_NUMBER, if has_own { printed[0] } else { longest }, longest]))
}

/// What a line comes to as it is printed, with so many figures more than usual: one more where it lies half way between two
/// of three, and of four the larger.
fn rounded(value: f64, more: usize) -> Option<f64> {
    let to = |value: f64, digits: usize| format!("{value:.*e}", digits - 1).parse::<f64>().ok();
    let digits = if value.abs() >= 1000.0 { 4 } else { 3 } + more;
    let usual = to(value, digits)?;
    let half = 0.5 * libm::exp10(libm::log10(value.abs()).floor() - digits as f64 + 1.0);
    // As the page has it.
    match ((value - usual).abs() - half).abs() <= 1e-6 * half {
        true if digits < 4 => to(value, digits + 1),
        true => to(value + 0.2 * half * value.signum(), digits),
        false => Some(usual),
    }
}

/// How two numbers of a line go together.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sign {
    Times,
    Over,
    Equals,
}

/// The sign between two numbers, and whether the first is squared; nothing where a line does more with them than that.
fn sign(words: &str) -> Option<(Sign, bool)> {
    let (squared, rest) = words.strip_prefix('²').map_or((false, words), |rest| (true, rest));
    let bare: String = rest.chars().filter(|c| !matches!(c, '\u{2066}'..='\u{2069}' | '\u{200e}')).collect();
    let mut found = None;
    for word in bare.split_whitespace() {
        let one = match word {
            "×" | "·" => Sign::Times,
            "/" => Sign::Over,
            "=" => Sign::Equals,
            _ if word.contains(['(', ')', '+', '−', '√', '|', ';', ',', '=']) => return None,
            _ => continue,
        };
        if found.replace(one).is_some() {
            return None;
        }
    }
    Some((found?, squared))
}

/// How long vectors are taken to be, by the names that the words of each have for the page.
pub(super) const TAKEN: [Lengths; 4] = [Lengths::Arrow, Lengths::Point, Lengths::Unmeasured, Lengths::Zero];
const NAMES_OF_TAKEN: [&str; 4] = ["arrow", "point", "unmeasured", "zero"];
/// A vector that is never shorter than this on the paper of the course is a point in no position, mm: what is fitted to a position is
/// drawn larger, but for few.
const NEVER_A_POINT: f64 = 4.0;

/// What is said of the positions with vectors taken to be so long.
pub(super) type Taken = (Lengths, Vec<Vec<Said>>);

/// A text is bound by no fewer positions than this.
const ENOUGH: usize = 3;

/// A length on paper is read to so many decimals of a millimetre, the last as a guard.
const FINEST: usize = 4;

/// Whether a length on paper is read a place further off than it is, as what would lie half way by the scale.
fn is_read_beside(text: &str, mm: f64) -> bool {
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let place = libm::exp10(-(decimals as f64));
    (2..=FINEST).contains(&decimals) && number_of(text).is_some_and(|read| (read - mm).abs() <= 1.001 * place)
}

/// A number as it stands in a text without a power of ten.
fn number_of(text: &str) -> Option<f64> {
    text.replace('\u{2009}', "").replace('−', "-").parse().ok()
}

/// Whether a number is printed so; one of three figures and more, but for one of its last place.
fn rounds_to(text: &str, value: f64) -> bool {
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let place = libm::exp10(-(decimals as f64));
    let is_long = text.chars().filter(char::is_ascii_digit).count() >= 3;
    is_long && number_of(text).is_some_and(|number| (number - value).abs() <= 1.001 * place)
        || (0..=GUARDS).any(|more| moving::printed(value, more) == text)
}

/// Everything that can be printed.
#[derive(Debug)]
pub(super) struct Printed {
    all: Vec<Candidate>,
    senses: [String; 2],
}

impl Printed {
    /// What a sweep computes at positions that were drawn.
    pub(super) fn of(
        sweep: &Sweep,
        (places, numbers): (&[f64], &[Vec<Option<f64>>]),
        polygons: &[Paper<'_>],
        input: f64,
        senses: [String; 2],
    ) -> Self {
        let mut all = Vec::new();
        let mut add = |form: Form,
                       output: usize,
                       si: f64,
                       panel: Option<usize>,
                       of: &dyn Fn(&[Option<f64>]) -> Option<f64>| {
            let values: Option<Vec<f64>> = numbers.iter().map(|all| Some(of(all)? / si)).collect();
            if let Some(values) = values {
                all.push(Candidate { form, output, si, panel, values });
            }
        };
        for (index, column) in sweep.columns.iter().enumerate() {
            let quantity = column.asked.quantity;
            let alike = sweep.columns.iter().filter(|other| {
                other.asked.quantity.order() == quantity.order()
                    && other.axis.is_none() == column.axis.is_none()
            });
            let mut units: Vec<f64> =
                alike.map(|other| other.asked.unit.si).chain([column.asked.unit.si]).collect();
            units.sort_by(f64::total_cmp);
            units.dedup();
            match column.axis {
                None => {
                    for si in units {
                        add(Form::Size, index, si, None, &|all| Some(all[index]?.abs()));
                        add(Form::Signed, index, si, None, &|all| all[index]);
                    }
                }
                Some(0) => {
                    let length = |all: &[Option<f64>]| Some(libm::hypot(all[index]?, all[index + 1]?));
                    for si in units {
                        add(Form::Length, index, si, None, &length);
                    }
                    for (panel, si_per_mm, _) in polygons.iter().filter(|(.., on)| on(quantity)) {
                        add(Form::OnPaper, index, *si_per_mm, Some(*panel), &length);
                    }
                    add(Form::Direction, index, 1.0, None, &|all| {
                        Some(libm::atan2(all[index + 1]?, all[index]?))
                    });
                }
                Some(_) => {}
            }
        }
        let values = places.iter().map(|at| at / input).collect();
        let points = sweep.columns.iter().enumerate().filter_map(|(index, column)| {
            let is_place = matches!(column.asked.quantity, Quantity::Position(_)) && column.axis == Some(0);
            is_place.then_some(index)
        });
        let points: Vec<usize> = points.collect();
        if let Some((_, si_per_mm, _)) = polygons.first() {
            for (i, a) in points.iter().enumerate() {
                for b in &points[i + 1..] {
                    let apart = |all: &Vec<Option<f64>>| {
                        Some(libm::hypot(all[*b]? - all[*a]?, all[b + 1]? - all[a + 1]?) / si_per_mm)
                    };
                    let values: Option<Vec<f64>> = numbers.iter().map(apart).collect();
                    let between = |values| Candidate {
                        form: Form::Between,
                        output: *a,
                        si: *si_per_mm,
                        panel: Some(*b),
                        values,
                    };
                    all.extend(values.map(between));
                }
            }
        }
        all.push(Candidate { form: Form::Input, output: 0, si: input, panel: None, values });
        Self { all, senses }
    }

    /// What stands in the place of a number that is printed so in some of the positions, the scene's own first: there to the
    /// last figure, elsewhere but for what rounding on the way has made of that. `on_paper`: a length on the paper of a polygon;
    /// `read`: the outputs that the page tells as they are read, every other it tells as it is.
    fn bound(
        &self,
        printed: &[&str],
        at: &[usize],
        on_paper: bool,
        read: &[usize],
    ) -> Option<(Value, Option<OnPaper>)> {
        let (own, others) = printed.split_first()?;
        let more = |candidate: &Candidate| {
            let values = || at.iter().map(|index| candidate.values[*index]);
            let first = values().next()?;
            let is = |text: &str, value: f64, more: usize| match candidate.form {
                Form::OnPaper | Form::Between => moving::printed_mm(value, more) == text,
                Form::Direction => moving::printed_degrees(value) == text,
                Form::Input => moving::printed_stated(value) == text,
                Form::Length => {
                    moving::printed(value, more) == text
                        || read.contains(&candidate.output)
                            && self.as_read(candidate.output, candidate.si, at[0], text)
                }
                Form::Size | Form::Signed => moving::printed(value, more) == text,
            };
            let figures = match candidate.form {
                Form::OnPaper | Form::Between => 1..=FINEST,
                Form::Direction | Form::Input => 0..=0,
                _ => 0..=GUARDS,
            };
            let more = figures.clone().find(|more| is(own, first, *more))?;
            let rounded = |((text, value), place): ((&&str, f64), &usize)| match candidate.form {
                Form::Size | Form::Signed => rounds_to(text, value),
                Form::Length => {
                    rounds_to(text, value) || self.as_read(candidate.output, candidate.si, *place, text)
                }
                Form::OnPaper | Form::Between => {
                    figures.clone().any(|more| is(text, value, more)) || is_read_beside(text, value)
                }
                _ => figures.clone().any(|more| is(text, value, more)),
            };
            others.iter().zip(values().skip(1)).zip(&at[1..]).all(rounded).then_some(more)
        };
        let mut all = self.all.iter().filter(|candidate| !on_paper || candidate.form == Form::OnPaper);
        all.find_map(|candidate| {
            let more = more(candidate)?;
            let Candidate { form, output, si, panel, .. } = candidate;
            let piece = json!([form.code(), output, si, more, panel]);
            let on = panel.filter(|_| *form == Form::OnPaper);
            Some((piece, on.map(|panel| OnPaper { panel, si_per_mm: *si, output: *output })))
        })
    }

    /// Whether a text is what the scale makes of a vector as it is read off its paper in a position.
    fn as_read(&self, output: usize, si: f64, at: usize, text: &str) -> bool {
        let mut papers = self.all.iter().filter(|c| c.form == Form::OnPaper && c.output == output);
        papers.any(|paper| {
            (1..=FINEST).any(|decimals| {
                let place = libm::exp10(-(decimals as f64));
                let Ok(near) = moving::printed_mm(paper.values[at], decimals).parse::<f64>() else {
                    return false;
                };
                // What would lie half way is read a place further off.
                let beside: &[f64] = if decimals > 1 { &[0.0, -1.0, 1.0] } else { &[0.0] };
                beside.iter().any(|places| {
                    let read = (near + places * place) * paper.si / si;
                    (0..=GUARDS).any(|more| moving::printed(read, more) == text)
                })
            })
        })
    }

    fn tokens(&self, text: &str) -> Vec<Token> {
        let mut all = vec![Token::Words(String::new())];
        let mut rest = text;
        let mut before = ' ';
        let mut script = 0_u32;
        while let Some(first) = rest.chars().next() {
            let sense = self.senses.iter().find(|word| {
                let ends = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
                rest.starts_with(word.as_str())
                    && !before.is_alphanumeric()
                    && ends(rest[word.len()..].chars().next())
            });
            let length =
                if script == 0 && !before.is_alphanumeric() && before != '.' { number(rest) } else { 0 };
            let taken = match (sense, length) {
                (Some(word), _) => {
                    all.push(Token::Sense(word.clone()));
                    word.len()
                }
                (None, 1..) => {
                    all.push(Token::Number(rest[..length].to_owned()));
                    length
                }
                _ => {
                    for (tag, by) in [("<sub>", 1), ("<sup>", 1), ("</sub>", -1), ("</sup>", -1)] {
                        if rest.starts_with(tag) {
                            script = script.saturating_add_signed(by);
                        }
                    }
                    match all.last_mut() {
                        Some(Token::Words(words)) => words.push(first),
                        _ => all.push(Token::Words(first.to_string())),
                    }
                    first.len_utf8()
                }
            };
            before = rest[..taken].chars().next_back().unwrap_or(' ');
            rest = &rest[taken..];
        }
        all
    }

    /// A text that is printed so in the positions: as it stands where it is the same in all, in pieces where every number
    /// of it is bound, else under `own`.
    fn text(&self, printed: &[&str], of_an_instant: &[String], told: &mut Calculated) -> Value {
        let places: Vec<usize> = (0..printed.len()).collect();
        self.text_at(&places, printed, of_an_instant, told)
    }

    /// Those of some positions in which a text has the words that it has in most.
    fn most_alike(&self, places: &[usize], printed: &[&str]) -> Vec<usize> {
        let tokens: Vec<Vec<Token>> = places.iter().map(|place| self.tokens(printed[*place])).collect();
        let agree = |own: &Vec<Token>| -> Vec<usize> {
            let all = places.iter().zip(&tokens).filter(|(_, other)| alike(other, own));
            all.map(|(place, _)| *place).collect()
        };
        // Of several that are as many the first.
        tokens.iter().map(agree).rev().max_by_key(Vec::len).unwrap_or_default()
    }

    /// The same of some of the positions, the first of which has the words; where these are said of the scene's own position alone, the
    /// text has them under `own`, and under [`ELSEWHERE`] what is said in the others.
    fn text_at(
        &self,
        places: &[usize],
        printed: &[&str],
        of_an_instant: &[String],
        told: &mut Calculated,
    ) -> Value {
        let before = told.numbers.len();
        let mut text = self.in_pieces(places, printed, of_an_instant, told);
        if text.is_object() {
            // What stands nowhere is not told.
            told.numbers.truncate(before);
        }
        // Where the scene stands, something may be zero or fall together, and is said in other words and numbers.
        if let ([0, others @ ..], true) = (places, text.is_object())
            && others.len() >= ENOUGH
        {
            let elsewhere = self.in_pieces(&self.most_alike(others, printed), printed, of_an_instant, told);
            if elsewhere.is_object() {
                told.numbers.truncate(before);
            } else {
                text[ELSEWHERE] = elsewhere;
            }
        }
        let pieces = text.get(ELSEWHERE).unwrap_or(&text);
        let read = pieces.as_array().into_iter().flatten().filter(|piece| piece.get(0) == Some(&json!(READ)));
        told.read.extend(read.filter_map(|piece| usize::try_from(piece.get(1)?.as_u64()?).ok()));
        text
    }

    fn in_pieces(
        &self,
        places: &[usize],
        printed: &[&str],
        of_an_instant: &[String],
        told: &mut Calculated,
    ) -> Value {
        let Some(first) = places.first().and_then(|place| printed.get(*place)) else { return json!("") };
        let own = || json!({ "own": first });
        let tokens: Vec<Vec<Token>> = printed.iter().map(|text| self.tokens(text)).collect();
        // Where it is said in other words, too: there this one is not.
        let (at, elsewhere): (Vec<usize>, Vec<usize>) =
            places.iter().partition(|index| alike(&tokens[places[0]], &tokens[**index]));
        let all: Vec<&Vec<Token>> = at.iter().map(|index| &tokens[*index]).collect();
        let Some(one) = all.first().copied().filter(|_| all.len() >= ENOUGH.min(tokens.len())) else {
            return own();
        };
        let has_sense = one.iter().any(|token| matches!(token, Token::Sense(_)));
        if of_an_instant.iter().any(|words| first.contains(words.as_str())) {
            return own();
        }
        // Of a length that stays the same the paper may not: its scale may be chosen anew in every position.
        let on_paper = |index: usize| matches!(one.get(index + 1), Some(Token::Words(words)) if words.starts_with("\u{a0}mm"));
        let has_paper = (0..one.len()).any(|index| matches!(one[index], Token::Number(_)) && on_paper(index));
        if !has_sense && !has_paper && places.iter().all(|place| printed[*place] == *first) {
            return json!(first);
        }
        let mut pieces: Vec<Value> = Vec::new();
        let mut turns: Vec<usize> = Vec::new();
        let mut reading: Option<Reading<'_>> = None;
        let mut reads: Vec<OnPaper> = Vec::new();
        for (index, token) in one.iter().enumerate() {
            let same: Option<Vec<&str>> = all
                .iter()
                .map(|tokens| match (token, tokens.get(index)?) {
                    (Token::Words(_), Token::Words(text))
                    | (Token::Number(_), Token::Number(text))
                    | (Token::Sense(_), Token::Sense(text)) => Some(text.as_str()),
                    _ => None,
                })
                .collect();
            let Some(same) = same else { return own() };
            let constant = same.iter().all(|text| *text == same[0]);
            match token {
                Token::Words(text) if constant => pieces.push(json!(text)),
                Token::Number(text)
                    if let (true, Some(reading)) =
                        (constant, reading.as_mut().filter(|reading| reading.si.is_none())) =>
                {
                    // The scale by which it is multiplied.
                    let OnPaper { panel, si_per_mm, .. } = reading.on;
                    let mut units = self.all.iter().filter(|c| c.form == Form::Length).map(|c| c.si);
                    reading.si = units.find(|si| moving::printed_stated(si_per_mm / si) == *text);
                    pieces.push(reading.si.map_or_else(|| json!(text), |si| json!([FACTOR, panel, si])));
                }
                Token::Number(text) if constant => {
                    let exact = self.turning(&same, &at, 0.0);
                    turns.splice(0..0, exact);
                    let bound = if on_paper(index) { self.bound(&same, &at, true, &told.read) } else { None };
                    let Some((piece, Some(on))) = bound else {
                        pieces.push(json!(text));
                        continue;
                    };
                    reads.push(on);
                    reading = Some(Reading { on, piece: pieces.len(), printed: same, si: None });
                    pieces.push(piece);
                }
                Token::Number(_) => {
                    if let Some(read) = &reading
                        && let Some((si, more)) = self.amount(read, &same, &at)
                    {
                        pieces[read.piece] = json!([READ, read.on.output, si, more, read.on.panel]);
                        pieces.push(json!([AMOUNT]));
                        continue;
                    }
                    // A number stands everywhere as it was told; and what a line calculates is calculated from the numbers
                    // before it as they are printed: so the line closes.
                    let is_everywhere = (0..tokens.len()).all(|place| place == 0 || at.contains(&place));
                    let known = told.told(&same, &at);
                    let known = known.or_else(|| {
                        if is_everywhere { self.calculated(&all, &tokens, &pieces, told) } else { None }
                    });
                    let bound = known
                        .map(|piece| (piece, None))
                        .or_else(|| self.bound(&same, &at, false, &told.read))
                        .or_else(|| Some((one_number(&same, at.first() == Some(&0))?, None)));
                    let Some((piece, on)) = bound else { return own() };
                    turns.splice(0..0, self.turning(&same, &at, AS_READ));
                    if let Some(on) = on {
                        reads.push(on);
                        reading = Some(Reading { on, piece: pieces.len(), printed: same, si: None });
                    }
                    pieces.push(piece);
                }
                Token::Sense(_) => {
                    let follows = |output: &usize| {
                        let values = self.all.iter().find(|c| c.form == Form::Signed && c.output == *output);
                        values.is_some_and(|c| {
                            at.iter().map(|index| c.values[*index]).zip(&same).all(|(value, word)| {
                                *word == self.senses[usize::from(value < 0.0)] && value != 0.0
                            })
                        })
                    };
                    // Which way a stated angle turns is the same everywhere.
                    let of_angle = |piece: &Value| piece.as_str().is_some_and(|text| text.starts_with('°'));
                    match turns.iter().copied().find(follows) {
                        Some(output) => pieces.push(json!([6, output])),
                        None if constant && pieces.last().is_some_and(of_angle) => {
                            pieces.push(json!(same[0]))
                        }
                        None => return own(),
                    }
                }
                Token::Words(_) => return own(),
            }
        }
        // It is said otherwise only where what it reads is no longer than a point: so the page can tell where it does not hold.
        let is_point = |index: &usize| {
            reads.iter().any(|on| {
                let mut papers = self.all.iter().filter(|c| c.form == Form::OnPaper && c.output == on.output);
                papers.any(|paper| paper.panel == Some(on.panel) && is_a_point(paper.values[*index]))
            })
        };
        if !elsewhere.iter().all(is_point) {
            return own();
        }
        json!(pieces)
    }

    /// Of what was read, and is told by these numbers: SI units of its unit, and its figures more than usual. Each is the
    /// number itself, or what the scale makes of what was read.
    fn amount(&self, read: &Reading<'_>, printed: &[&str], at: &[usize]) -> Option<(f64, usize)> {
        let si = read.si?;
        let of = |c: &&Candidate| c.form == Form::Length && c.output == read.on.output && c.si == si;
        let exact = self.all.iter().find(of)?;
        let mut each = at.iter().zip(&read.printed).zip(printed).map(|((index, read_mm), text)| {
            let exact = exact.values[*index];
            // As a number: what is exactly a shorter one is printed as one.
            let amount = read_mm.parse::<f64>().ok()? * read.on.si_per_mm / si;
            (0..=GUARDS).find(|more| {
                moving::printed(exact, *more) == *text
                    || (number_of(text).is_some()
                        && number_of(&moving::printed(amount, *more)) == number_of(text))
            })
        });
        let more = each.next()??;
        each.all(|more| more.is_some()).then_some((si, more))
    }

    /// A number that its line calculates from those before it, as they are printed, in every position that is taken; or from a distance
    /// on paper by the scale of the skeleton. `everywhere`: the line in all positions, whose own may have other words.
    fn calculated(
        &self,
        all: &[&Vec<Token>],
        everywhere: &[Vec<Token>],
        pieces: &[Value],
        told: &mut Calculated,
    ) -> Option<Value> {
        let index = pieces.len();
        let number = |tokens: &[Token], index: usize| match tokens.get(index) {
            Some(Token::Number(text)) => value_of(text),
            _ => None,
        };
        let operand = |index: usize| match pieces.get(index)? {
            Value::String(text) => value_of(text).map(|value| json!(value)),
            piece => match u32::try_from(piece.get(0)?.as_u64()?).ok()? {
                // What is read by a scale in force hangs on what stood before it.
                AMOUNT | FACTOR | READ => None,
                CALCULATED => Some(json!([CALCULATED, piece.get(1)?])),
                _ => Some(piece.clone()),
            },
        };
        let before = |back: usize| match all.first()?.get(index.checked_sub(back)?)? {
            Token::Words(words) => Some(words.as_str()),
            _ => None,
        };
        // By token, and whether it divides.
        let mut operands: Vec<(usize, bool)> = Vec::new();
        let mut scale = 1.0;
        let is_between = |piece: &Value| piece.get(0) == Some(&json!(Form::Between.code()));
        if pieces.get(index.checked_sub(2)?).is_some_and(is_between) {
            operands.push((index - 2, false));
            let lengths = self.all.iter().filter(|c| c.form == Form::Length).map(|c| c.si);
            let first = all.first()?;
            let (mm, come) = (number(first, index - 2)?, number(first, index)?);
            let per_mm = self.all.iter().find(|c| c.form == Form::Between)?.si;
            scale = lengths
                .map(|si| per_mm / si)
                .find(|scale| (0..=GUARDS).any(|more| rounded(mm * scale, more) == Some(come)))?;
        } else {
            let (mut back, mut after) = (1, before(1)?);
            if sign(after)?.0 != Sign::Equals {
                return None;
            }
            loop {
                let (at, squared) = (index.checked_sub(back + 1)?, sign(after)?.1);
                let left = before(back + 2)?;
                // Where the line begins to calculate nothing but its sign stands before the number.
                let begins = left.trim_end().ends_with('=');
                let divides = !begins && sign(left)?.0 == Sign::Over;
                operands.extend(std::iter::repeat_n((at, divides), 1 + usize::from(squared)));
                if begins {
                    break;
                }
                (back, after) = (back + 2, left);
            }
        }
        let printed = |tokens: &&Vec<Token>| match tokens.get(index) {
            Some(Token::Words(text) | Token::Number(text) | Token::Sense(text)) => text.clone(),
            None => String::new(),
        };
        let comes_to = |tokens: &&Vec<Token>| {
            operands.iter().try_fold(scale, |value, (index, divides)| {
                let own = number(tokens, *index)?;
                Some(if *divides { value / own } else { value * own })
            })
        };
        let more = |tokens: &&Vec<Token>| {
            // As the page has it: what is half way is so but for the last places of a double.
            let value: f64 = format!("{:.11e}", comes_to(tokens)?).parse().ok()?;
            let text = &printed(tokens);
            let digits = text.split('\u{a0}').next()?.chars().filter(char::is_ascii_digit);
            let written = digits.skip_while(|digit| *digit == '0').count();
            let usual = if value.abs() >= 1000.0 { 4 } else { 3 };
            // With as many figures as it is written, zeros at its end among them.
            let is_so = |more: &usize| rounded(value, *more) == value_of(text);
            (written.saturating_sub(usual)..=GUARDS).find(is_so).or_else(|| (0..=GUARDS).find(is_so))
        };
        let figures: Vec<usize> = all.iter().map(more).collect::<Option<_>>()?;
        let part = |divides: bool| {
            let own = operands.iter().filter(move |(_, other)| *other == divides);
            own.map(|(index, _)| operand(*index)).collect::<Option<Vec<_>>>()
        };
        let (mut factors, divisors) = (part(false)?, part(true)?);
        if scale != 1.0 {
            factors.push(json!(scale));
        }
        let is_varied = factors.iter().chain(&divisors).any(Value::is_array);
        if !is_varied {
            return None;
        }
        told.numbers.push(everywhere.iter().map(|tokens| printed(&tokens)).collect());
        // As many as it takes for what is calculated from it to come out in every position that was drawn.
        let most = figures.iter().max()?;
        Some(json!([CALCULATED, told.numbers.len() - 1, factors, divisors, most, figures.first()?]))
    }

    /// The signed scalars whose size is printed so or is off by no more than a part of itself, the nearest first.
    fn turning(&self, printed: &[&str], at: &[usize], room: f64) -> Vec<usize> {
        let off = |c: &Candidate| {
            let values = || at.iter().map(|index| c.values[*index]).zip(printed);
            let mut parts = values().map(|(value, text)| Some((value / value_of(text)? - 1.0).abs()));
            let most = parts.try_fold(0.0, |most: f64, part| Some(most.max(part?)))?;
            let fits = most <= room || values().all(|(value, text)| rounds_to(text, value));
            fits.then_some((most, c.output))
        };
        let mut all: Vec<(f64, usize)> =
            self.all.iter().filter(|c| c.form == Form::Size).filter_map(off).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().map(|(_, output)| output).collect()
    }

    /// The steps; the scene's own position is the first. `shortest`: by output the least length of a vector over the course, SI units.
    pub(super) fn steps(
        &self,
        positions: &[Vec<Said>],
        taken: &[Taken],
        shortest: &[f64],
        of_an_instant: &[String],
    ) -> Vec<Value> {
        let Some(own) = positions.first() else { return Vec::new() };
        let mut told = Calculated::default();
        // The cells of a table may hold what the lines below it calculate.
        let mut lines: Vec<Vec<Value>> = Vec::new();
        for index in 0..own.len() {
            let drawn = Lines::of(positions, index);
            let taken: Vec<Lines<'_>> =
                taken.iter().map(|(_, positions)| Lines::of(positions, index)).collect();
            let mut sentences = Vec::new();
            for key in Lines::keys(&drawn, &taken) {
                let line = Line { key, drawn: &drawn, taken: &taken };
                sentences.extend(self.line(&line, shortest, of_an_instant, &mut told));
            }
            lines.push(sentences);
        }
        let mut steps = Vec::new();
        for (index, (said, sentences)) in own.iter().zip(lines).enumerate() {
            let mut equations = Vec::new();
            for (e, rows) in said.equations.iter().enumerate() {
                let mut table = Vec::new();
                for (r, row) in rows.iter().enumerate() {
                    let cells = (0..row.len()).map(|c| {
                        let cell = |said: &Said| Some(said.equations.get(e)?.get(r)?.get(c)?.clone());
                        self.said_in(positions, index, of_an_instant, &mut told, &cell)
                    });
                    table.push(cells.collect::<Vec<_>>());
                }
                equations.push(table);
            }
            steps.push(json!({ "step": said.step, "head": said.head, "equations": equations, "sentences": sentences }));
        }
        steps
    }

    /// A sentence of a step; none where only another length would have one, and it hangs on none.
    fn line(
        &self,
        line: &Line<'_>,
        shortest: &[f64],
        of_an_instant: &[String],
        told: &mut Calculated,
    ) -> Option<Value> {
        let drawn = line.drawn.texts(line.key);
        if let Some(value) = self.by_length(line, &drawn, shortest, of_an_instant, told) {
            return Some(value);
        }
        let Some(first) = drawn.first().copied().flatten() else {
            return self.only_elsewhere(line, &drawn, of_an_instant, told);
        };
        Some(match drawn.into_iter().collect::<Option<Vec<&str>>>() {
            Some(printed) if line.drawn.is_alike => self.text(&printed, of_an_instant, told),
            _ => json!({ "own": first }),
        })
    }

    /// A sentence that the scene's own position does not have: what is zero there is not carried over.
    fn only_elsewhere(
        &self,
        line: &Line<'_>,
        drawn: &[Option<&str>],
        of_an_instant: &[String],
        told: &mut Calculated,
    ) -> Option<Value> {
        drawn.get(1..)?.iter().all(Option::is_some).then_some(())?;
        let printed: Vec<&str> = drawn.iter().map(|text| text.unwrap_or_default()).collect();
        let others: Vec<usize> = (1..printed.len()).collect();
        let most = self.most_alike(&others, &printed);
        let text = self.text_at(&most, &printed, of_an_instant, told);
        (line.drawn.is_alike && !text.is_object()).then(|| json!({ "own": "", ELSEWHERE: text }))
    }

    /// A sentence whose words hang on how long its vector is on paper: the output and the panel of that, and the words of each.
    fn by_length(
        &self,
        line: &Line<'_>,
        drawn: &[Option<&str>],
        shortest: &[f64],
        of_an_instant: &[String],
        told: &mut Calculated,
    ) -> Option<Value> {
        if !line.is_of_length() {
            return None;
        }
        // What would be said with a vector of another length may be nothing.
        let bare = |texts: Vec<Option<&'_ str>>| -> Vec<String> {
            texts.into_iter().map(|text| text.unwrap_or_default().to_owned()).collect()
        };
        let drawn = bare(drawn.to_vec());
        let taken: Vec<Vec<String>> = line.taken.iter().map(|lines| bare(lines.texts(line.key))).collect();
        let words = |text: &str| self.tokens(text);
        let own = taken.iter().position(|texts| alike(&words(&texts[0]), &words(&drawn[0])))?;
        let mut all: Vec<Option<Value>> = Vec::new();
        let mut is_verbatim = false;
        for (index, texts) in taken.iter().enumerate() {
            let printed: Vec<&str> = texts.iter().map(String::as_str).collect();
            let mut value = json!({});
            if index == own {
                // As it is drawn, wherever it has these words.
                let as_drawn: Vec<&str> = drawn.iter().map(String::as_str).collect();
                let own = words(as_drawn[0]);
                let places = (0..drawn.len()).filter(|place| alike(&words(as_drawn[*place]), &own));
                value = self.text_at(&places.collect::<Vec<_>>(), &as_drawn, of_an_instant, told);
            }
            if value.is_object() {
                // Where most positions agree: a length may be zero in one, or not to be measured.
                let places: Vec<usize> = (0..printed.len()).collect();
                value = self.text_at(&self.most_alike(&places, &printed), &printed, of_an_instant, told);
            }
            if let Some(elsewhere) = value.get(ELSEWHERE).cloned() {
                is_verbatim |= index == own;
                value = elsewhere;
            }
            all.push((!value.is_object()).then_some(value));
        }
        let Some((output, panel)) = all.iter().flatten().find_map(|value| self.paper_of(value)) else {
            // Where nobody knows how long it is elsewhere, that it is a point is said of the scene's own position only.
            return (own > 0).then(|| json!({ "own": drawn[0] }));
        };
        let si_per_mm = self.all.iter().find(|c| c.form == Form::OnPaper && c.panel == Some(panel))?.si;
        let is_ever_short = shortest.get(output)? / si_per_mm < NEVER_A_POINT;
        let mut value = json!({ "of": [output, panel] });
        for (index, (name, text)) in NAMES_OF_TAKEN.iter().zip(&all).enumerate() {
            // The page has the words of a point where it has none for what is shorter.
            let is_same = index > 1 && all[1] == *text;
            if let Some(text) =
                text.as_ref().filter(|_| index == own || index == 0 || is_ever_short && !is_same)
            {
                value[name] = text.clone();
            }
        }
        if is_verbatim || value.get(NAMES_OF_TAKEN[own]).is_none() {
            value["own"] = json!(drawn[0]);
        }
        Some(value)
    }

    /// The vector whose length a text tells, and the panel on whose paper it is.
    fn paper_of(&self, text: &Value) -> Option<(usize, usize)> {
        let index = |value: &Value| usize::try_from(value.as_u64()?).ok();
        text.as_array()?.iter().find_map(|piece| {
            let code = u32::try_from(piece.get(0)?.as_u64()?).ok()?;
            let output = index(piece.get(1)?)?;
            if code == READ || code == Form::OnPaper.code() {
                return Some((output, index(piece.get(4)?)?));
            }
            let is_length = code == Form::Length.code();
            let paper = self.all.iter().find(|c| c.form == Form::OnPaper && c.output == output);
            Some((output, paper.filter(|_| is_length)?.panel?))
        })
    }

    /// A text of a step, by what it is in each of the positions.
    fn said_in(
        &self,
        positions: &[Vec<Said>],
        index: usize,
        of_an_instant: &[String],
        told: &mut Calculated,
        of: &dyn Fn(&Said) -> Option<String>,
    ) -> Value {
        let all: Vec<&Said> = positions.iter().filter_map(|position| position.get(index)).collect();
        let Some(said) = all.first() else { return json!("") };
        let alike = all.len() == positions.len()
            && all
                .iter()
                .all(|other| other.step == said.step && other.equations.len() == said.equations.len());
        let printed: Option<Vec<String>> =
            if alike { all.iter().map(|said| of(said)).collect() } else { None };
        match printed {
            Some(printed) => {
                let printed: Vec<&str> = printed.iter().map(String::as_str).collect();
                self.text(&printed, of_an_instant, told)
            }
            None => json!({ "own": of(said) }),
        }
    }
}

/// Where a sentence stands in its step: after the act that was told last, so many sentences of no act.
type LineKey = (Option<usize>, usize);

/// The sentences of one step in every position.
struct Lines<'a> {
    each: Vec<Vec<(LineKey, &'a Sentence)>>,
    /// The step is the same in all positions.
    is_alike: bool,
}

impl<'a> Lines<'a> {
    fn of(positions: &'a [Vec<Said>], index: usize) -> Self {
        let said = || positions.iter().filter_map(|position| position.get(index));
        let step = said().next().map(|said| said.step);
        let keyed = |said: &'a Said| {
            let (mut act, mut count) = (None, 0);
            let key = |sentence: &'a Sentence| {
                (act, count) = if sentence.act.is_some() { (sentence.act, 0) } else { (act, count + 1) };
                ((act, count), sentence)
            };
            said.sentences.iter().map(key).collect()
        };
        Self {
            each: said().map(keyed).collect(),
            is_alike: said().count() == positions.len() && said().all(|said| Some(said.step) == step),
        }
    }

    /// The sentence of a key in each position.
    fn texts(&self, key: LineKey) -> Vec<Option<&'a str>> {
        let text = |all: &Vec<(LineKey, &'a Sentence)>| {
            all.iter().find(|(own, _)| *own == key).map(|(_, sentence)| sentence.text.as_str())
        };
        self.each.iter().map(text).collect()
    }

    /// All sentences of the scene's own position, in order, with those that it would have if vectors were of another length, or that
    /// another position has.
    fn keys(drawn: &Self, taken: &[Self]) -> Vec<LineKey> {
        let keys =
            |all: &Vec<(LineKey, &Sentence)>| -> Vec<LineKey> { all.iter().map(|(key, _)| *key).collect() };
        let own = drawn.each.first().map(keys).unwrap_or_default();
        let has_all = |more: &Vec<LineKey>| own.iter().all(|key| more.contains(key));
        let each = taken.iter().filter_map(|lines| lines.each.first()).chain(&drawn.each).map(keys);
        let longest = each.filter(has_all).fold(None, |longest: Option<Vec<LineKey>>, more| {
            // Of several that have as many the first.
            longest.filter(|own| own.len() >= more.len()).or(Some(more))
        });
        longest.unwrap_or(own)
    }
}

/// A sentence as it is drawn, and with vectors taken to be of other lengths.
struct Line<'a> {
    key: LineKey,
    drawn: &'a Lines<'a>,
    taken: &'a [Lines<'a>],
}

impl Line<'_> {
    fn is_of_length(&self) -> bool {
        let all = || std::iter::once(self.drawn).chain(self.taken);
        let has = |lines: &Lines<'_>| {
            lines.each.iter().flatten().any(|(key, sentence)| *key == self.key && sentence.is_of_length)
        };
        all().all(|lines| lines.is_alike && !lines.each.is_empty()) && all().any(has)
    }
}

/// How many bytes of a text are a printed number; a power of ten with it.
fn number(text: &str) -> usize {
    let mut length = 0;
    let mut digits = 0;
    for c in text.chars() {
        let goes_on = match c {
            '0'..='9' => true,
            '−' => length == 0,
            '.' | '\u{2009}' => {
                digits > 0 && text[length + c.len_utf8()..].starts_with(|c: char| c.is_ascii_digit())
            }
            _ => false,
        };
        if !goes_on {
            break;
        }
        digits += usize::from(c.is_ascii_digit());
        length += c.len_utf8();
    }
    if digits == 0 {
        return 0;
    }
    const TIMES: &str = "\u{a0}×\u{a0}10<sup>";
    if let Some(power) = text[length..].strip_prefix(TIMES)
        && let Some((exponent, _)) = power.split_once("</sup>")
    {
        length += TIMES.len() + exponent.len() + "</sup>".len();
    }
    if text[length..].starts_with('°') { length + '°'.len_utf8() } else { length }
}
