//! What is said of a step, with the numbers of every position.
//!
//! The sheet says the same step at some positions of the course. A number that is printed differently there is bound to
//! the output that is printed so in all of them, to the last figure; a sentence of which one number is bound to nothing,
//! or whose words differ, is said of the scene's own position only. So nothing here knows what a sentence means.

use serde_json::{Value, json};

use crate::mechanism::quantity::Quantity;
use crate::sheet::moving::{self, Said};
use crate::sweep::Sweep;

/// More figures than this no factor of a line has.
const GUARDS: usize = 4;

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

    /// What stands in the place of a number that is printed so in the positions.
    fn bound(&self, printed: &[&str]) -> Option<(Value, Option<(usize, f64)>)> {
        let more = |candidate: &Candidate| {
            let each = candidate.values.iter().zip(printed).map(|(value, text)| match candidate.form {
                Form::OnPaper => (1..=2).find(|decimals| moving::printed_mm(*value, *decimals) == *text),
                Form::Direction => (moving::printed_degrees(*value) == *text).then_some(0),
                Form::Input => (moving::printed_stated(*value) == *text).then_some(0),
                _ => (0..=GUARDS).find(|more| moving::printed(*value, *more) == *text),
            });
            each.collect::<Option<Vec<usize>>>().and_then(|all| all.into_iter().max())
        };
        self.all.iter().find_map(|candidate| {
            let more = more(candidate)?;
            let Candidate { form, output, si, panel, .. } = candidate;
            Some((json!([form.code(), output, si, more, panel]), panel.map(|panel| (panel, *si))))
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
        let all: Vec<Vec<Token>> = printed.iter().map(|text| self.tokens(text)).collect();
        let one = &all[0];
        let has_sense = one.iter().any(|token| matches!(token, Token::Sense(_)));
        if of_an_instant.iter().any(|words| first.contains(words.as_str())) {
            return own();
        }
        if !has_sense && printed.iter().all(|text| text == first) {
            return json!(first);
        }
        let mut pieces: Vec<Value> = Vec::new();
        let mut turns: Option<usize> = None;
        // The paper on which a length was just read, and how it is printed.
        let mut paper: Option<(usize, f64, Vec<&str>)> = None;
        let mut factor: Option<f64> = None;
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
                Token::Number(text) if constant && paper.is_some() && factor.is_none() => {
                    // The scale by which it is multiplied.
                    let found = paper.as_ref().and_then(|(panel, si_per_mm, _)| {
                        let units = self.all.iter().filter(|c| c.form == Form::Length).map(|c| c.si);
                        let mut fits = units.filter(|si| moving::printed_stated(si_per_mm / si) == *text);
                        fits.next().map(|si| (*panel, si, si_per_mm / si))
                    });
                    match found {
                        Some((panel, si, by)) => {
                            factor = Some(by);
                            pieces.push(json!([8, panel, si]));
                        }
                        None => pieces.push(json!(text)),
                    }
                }
                Token::Number(text) if constant => {
                    turns = self.turning(&same).or(turns);
                    pieces.push(json!(text));
                }
                Token::Number(_) => match (self.bound(&same), &paper, factor) {
                    (Some((piece, on)), ..) => {
                        turns = self.turning(&same);
                        pieces.push(piece);
                        if let Some((panel, si_per_mm)) = on {
                            (paper, factor) = (Some((panel, si_per_mm, same)), None);
                        }
                    }
                    // No ruler reads finer: it is that of what was read.
                    (None, Some((.., read)), Some(by)) => {
                        // As a number: what is exactly a shorter one is printed as one.
                        let value = |text: &str| text.replace('\u{2009}', "").parse::<f64>().ok();
                        let fits = |more: &usize| {
                            read.iter().zip(&same).all(|(read, text)| {
                                let read: f64 = read.parse().unwrap_or(f64::NAN);
                                let is = |more| value(&moving::printed(read * by, more)) == value(text);
                                value(text).is_some() && (0..=*more).any(is)
                            })
                        };
                        match (0..=GUARDS).find(fits) {
                            Some(more) => pieces.push(json!([7, more])),
                            None => return own(),
                        }
                    }
                    _ => return own(),
                },
                Token::Sense(_) => {
                    let follows = |output: &usize| {
                        let values = self.all.iter().find(|c| c.form == Form::Signed && c.output == *output);
                        values.is_some_and(|c| {
                            c.values.iter().zip(&same).all(|(value, word)| {
                                *word == self.senses[usize::from(*value < 0.0)] && *value != 0.0
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
        if all.iter().any(|tokens| tokens.len() != one.len()) {
            return own();
        }
        json!(pieces)
    }

    /// The signed scalar whose size is printed so.
    fn turning(&self, printed: &[&str]) -> Option<usize> {
        let fits = |c: &&Candidate| {
            c.form == Form::Size
                && c.values
                    .iter()
                    .zip(printed)
                    .all(|(value, text)| (0..=GUARDS).any(|more| moving::printed(*value, more) == *text))
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
