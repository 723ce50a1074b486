//! What is said of a step, with the numbers of every position.
//!
//! The sheet says the same step at some positions of the course. A number that is printed differently there is bound to
//! the output that is printed so in all of them, to the last figure; a sentence of which one number is bound to nothing,
//! or whose words differ, is said of the scene's own position only. So nothing here knows what a sentence means.

use serde_json::{Value, json};

use crate::graphical::is_a_point;
use crate::mechanism::quantity::Quantity;
use crate::sheet::moving::{self, Said};
use crate::sweep::Sweep;

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
    /// The panel on whose paper it is.
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

/// A text is bound by no fewer positions than this.
const ENOUGH: usize = 3;

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
        all.push(Candidate { form: Form::Input, output: 0, si: input, panel: None, values });
        Self { all, senses }
    }

    /// What stands in the place of a number that is printed so in some of the positions, the scene's own first: there to the
    /// last figure, elsewhere but for what rounding on the way has made of that. `on_paper`: a length on the paper of a polygon.
    fn bound(&self, printed: &[&str], at: &[usize], on_paper: bool) -> Option<(Value, Option<OnPaper>)> {
        let (own, others) = printed.split_first()?;
        let more = |candidate: &Candidate| {
            let values = || at.iter().map(|index| candidate.values[*index]);
            let first = values().next()?;
            let is = |text: &str, value: f64, more: usize| match candidate.form {
                Form::OnPaper => moving::printed_mm(value, more) == text,
                Form::Direction => moving::printed_degrees(value) == text,
                Form::Input => moving::printed_stated(value) == text,
                Form::Length => {
                    moving::printed(value, more) == text
                        || self.as_read(candidate.output, candidate.si, at[0], text)
                }
                Form::Size | Form::Signed => moving::printed(value, more) == text,
            };
            let figures = match candidate.form {
                Form::OnPaper => 1..=2,
                Form::Direction | Form::Input => 0..=0,
                _ => 0..=GUARDS,
            };
            let more = figures.clone().find(|more| is(own, first, *more))?;
            let rounded = |((text, value), place): ((&&str, f64), &usize)| match candidate.form {
                Form::Size | Form::Signed => rounds_to(text, value),
                Form::Length => {
                    rounds_to(text, value) || self.as_read(candidate.output, candidate.si, *place, text)
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
            Some((piece, panel.map(|panel| OnPaper { panel, si_per_mm: *si, output: *output })))
        })
    }

    /// Whether a text is what the scale makes of a vector as it is read off its paper in a position.
    fn as_read(&self, output: usize, si: f64, at: usize, text: &str) -> bool {
        let mut papers = self.all.iter().filter(|c| c.form == Form::OnPaper && c.output == output);
        papers.any(|paper| {
            (1..=2).any(|decimals| {
                let read = moving::printed_mm(paper.values[at], decimals)
                    .parse::<f64>()
                    .map(|mm| mm * paper.si / si);
                read.is_ok_and(|read| (0..=GUARDS).any(|more| moving::printed(read, more) == text))
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
    fn text(&self, printed: &[&str], of_an_instant: &[String]) -> Value {
        let Some(first) = printed.first() else { return json!("") };
        let own = || json!({ "own": first });
        let tokens: Vec<Vec<Token>> = printed.iter().map(|text| self.tokens(text)).collect();
        // Where it is said in other words, too: there this one is not.
        let (at, elsewhere): (Vec<usize>, Vec<usize>) =
            (0..tokens.len()).partition(|index| alike(&tokens[0], &tokens[*index]));
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
        if !has_sense && !has_paper && printed.iter().all(|text| text == first) {
            return json!(first);
        }
        let mut pieces: Vec<Value> = Vec::new();
        let mut turns: Option<usize> = None;
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
                    turns = self.turning(&same, &at).or(turns);
                    let bound = if on_paper(index) { self.bound(&same, &at, true) } else { None };
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
                    let Some((piece, on)) = self.bound(&same, &at, false) else { return own() };
                    turns = self.turning(&same, &at);
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
                    match turns.filter(follows) {
                        Some(output) => pieces.push(json!([6, output])),
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

    /// The signed scalar whose size is printed so.
    fn turning(&self, printed: &[&str], at: &[usize]) -> Option<usize> {
        let fits = |c: &&Candidate| {
            let mut values = at.iter().map(|index| c.values[*index]).zip(printed);
            c.form == Form::Size && values.all(|(value, text)| rounds_to(text, value))
        };
        self.all.iter().find(fits).map(|candidate| candidate.output)
    }

    /// The steps; the scene's own position is the first.
    pub(super) fn steps(&self, positions: &[Vec<Said>], of_an_instant: &[String]) -> Vec<Value> {
        let Some(own) = positions.first() else { return Vec::new() };
        let step = |(index, said): (usize, &Said)| {
            let all: Vec<&Said> = positions.iter().filter_map(|p| p.get(index)).collect();
            let alike = all.len() == positions.len()
                && all.iter().all(|other| {
                    other.step == said.step
                        && other.sentences.len() == said.sentences.len()
                        && other.equations.len() == said.equations.len()
                });
            let text = |of: &dyn Fn(&Said) -> Option<String>| {
                let printed: Option<Vec<String>> =
                    if alike { all.iter().map(|said| of(said)).collect() } else { None };
                match printed {
                    Some(printed) => {
                        let printed: Vec<&str> = printed.iter().map(String::as_str).collect();
                        self.text(&printed, of_an_instant)
                    }
                    None => json!({ "own": of(said) }),
                }
            };
            let cell = |e: usize, r: usize, c: usize| {
                text(&|said| Some(said.equations.get(e)?.get(r)?.get(c)?.clone()))
            };
            let equations: Vec<Value> = (0..said.equations.len())
                .map(|e| {
                    let rows = said.equations[e].iter().enumerate();
                    let rows = rows.map(|(r, row)| (0..row.len()).map(|c| cell(e, r, c)).collect::<Vec<_>>());
                    json!(rows.collect::<Vec<_>>())
                })
                .collect();
            let sentences: Vec<Value> =
                (0..said.sentences.len()).map(|s| text(&|said| said.sentences.get(s).cloned())).collect();
            json!({ "step": said.step, "head": said.head, "equations": equations, "sentences": sentences })
        };
        own.iter().enumerate().map(step).collect()
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
