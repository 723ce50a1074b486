//! What people type in answers as what the readers know: the digits of Persian and Arabic, the minus sign of printed
//! texts, the sign of degrees, and words for the sense of a rotation.

use std::borrow::Cow;

use crate::mechanism::Sense;
use crate::scene::diagnostic::{Fault, Res};
use crate::scene::units::{Scale, Words};

/// The same text with the digits of ASCII, `٫` as the decimal point, `٬` left out between digits, a printed minus sign as
/// a hyphen, and `°` as the name of that unit.
#[must_use]
pub(crate) fn with_plain_digits(text: &str) -> Cow<'_, str> {
    let typed = |sign| matches!(sign, DECIMAL | THOUSANDS | DEGREES) || MINUS.contains(&sign);
    if !text.chars().any(|sign| plain_digit(sign).is_some() || typed(sign)) {
        return Cow::Borrowed(text);
    }
    let is_digit =
        |sign: Option<char>| sign.is_some_and(|sign| sign.is_ascii_digit() || plain_digit(sign).is_some());
    let numeral = |sign: Option<&char>| is_digit(sign.copied()) || matches!(sign, Some('.' | &DECIMAL));
    let mut plain = String::with_capacity(text.len());
    let mut before = None;
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let between = is_digit(before) && is_digit(signs.peek().copied());
        match (sign, plain_digit(sign)) {
            (_, Some(digit)) => plain.push(digit),
            (DECIMAL, _) => plain.push('.'),
            // Between two numbers it is a stroke.
            (sign, _) if MINUS.contains(&sign) && !is_digit(before) && numeral(signs.peek()) => {
                plain.push('-')
            }
            (DEGREES, _) if is_digit(before) || matches!(before, Some(' ' | '.')) => plain.push_str(" deg"),
            (THOUSANDS, _) if between => {}
            _ => plain.push(sign),
        }
        before = Some(sign);
    }
    Cow::Owned(plain)
}

/// The Arabic sign that parts decimals.
const DECIMAL: char = '\u{66b}';
/// The Arabic sign between thousands.
const THOUSANDS: char = '\u{66c}';

const DEGREES: char = '°';
/// The minus sign of printed texts, and the stroke that writing programs make of a hyphen.
const MINUS: [char; 2] = ['\u{2212}', '\u{2013}'];

/// The same text with the sense of a rotation at its end as `cw` or `ccw`.
pub(super) fn with_plain_sense(text: &str) -> Cow<'_, str> {
    let whole = text.trim_end();
    let lower = whole.to_ascii_lowercase();
    for (word, sense) in SENSES {
        let Some(before) = lower.strip_suffix(word) else { continue };
        if before.ends_with(|sign: char| sign.is_alphanumeric() || sign == '-') {
            continue;
        }
        return Cow::Owned(format!("{}{sense}", &whole[..before.len()]));
    }
    Cow::Borrowed(text)
}

/// How people write a sense, what holds another before it.
const SENSES: [(&str, &str); 19] = [
    ("counter clockwise", "ccw"),
    ("counter-clockwise", "ccw"),
    ("counterclockwise", "ccw"),
    ("anti clockwise", "ccw"),
    ("anti-clockwise", "ccw"),
    ("anticlockwise", "ccw"),
    ("ccw", "ccw"),
    ("clockwise", "cw"),
    ("cw", "cw"),
    ("بعكس عقارب الساعة", "ccw"),
    ("عكس عقارب الساعة", "ccw"),
    ("باتجاه عقارب الساعة", "cw"),
    ("في اتجاه عقارب الساعة", "cw"),
    ("اتجاه عقارب الساعة", "cw"),
    ("مع عقارب الساعة", "cw"),
    ("پادساعتگرد", "ccw"),
    ("ساعتگرد", "cw"),
    ("↺", "ccw"),
    ("↻", "cw"),
];

/// The same text with its unit as scenes write it, where people write it otherwise: `N m` and `Nm`, `rad/sec`, `1/s`.
pub(super) fn with_plain_unit(text: &str) -> Cow<'_, str> {
    let words = Words::split(text);
    let unit = words.as_ref().map_or(text.trim(), |words| words.unit);
    if unit.is_empty() || Scale::parse(unit, 0).is_ok() {
        return Cow::Borrowed(text);
    }
    let plain = plain_unit(unit);
    match (Scale::parse(&plain, 0).is_ok(), words) {
        (false, _) => Cow::Borrowed(text),
        (true, None) => Cow::Owned(plain),
        (true, Some(words)) => {
            let sense = match words.sense {
                Some(Sense::Cw) => " cw",
                Some(Sense::Ccw) => " ccw",
                None => "",
            };
            Cow::Owned(format!("{} {plain}{sense}", words.digits))
        }
    }
}

/// A unit whose factors, powers and names are written as scenes write them.
fn plain_unit(unit: &str) -> String {
    let unit = unit.replace('×', "*");
    let (before, power) = INVERSE
        .iter()
        .find_map(|(end, power)| Some((unit.strip_suffix(end)?, *power)))
        .unwrap_or((&unit, ""));
    let mut plain = String::new();
    for part in before.trim_end_matches([' ', '*']).split_inclusive(['/', '*']) {
        let factor = part.trim_end_matches(['/', '*']);
        let (name, exponent) = factor.split_at(factor.find(['^', '²']).unwrap_or(factor.len()));
        let name = name.trim();
        let known = UNITS.iter().find(|(written, _)| *written == name || *written == name.to_lowercase());
        plain.push_str(known.map_or(name, |(_, ours)| ours));
        plain.push_str(exponent);
        plain.push_str(&part[factor.len()..]);
    }
    // What turns by a number in a second turns by radians.
    if plain.is_empty() || plain == "1" {
        plain = "rad".to_owned();
    }
    plain.strip_prefix("1/").map_or(plain.clone(), |rest| format!("rad/{rest}")) + power
}

/// Seconds behind a unit, as a power with a minus sign.
const INVERSE: [(&str, &str); 4] = [("s^-1", "/s"), ("s^-2", "/s^2"), ("s⁻¹", "/s"), ("s⁻²", "/s^2")];

/// Names of units as people write them, and as scenes do.
const UNITS: [(&str, &str); 18] = [
    ("Nm", "N*m"),
    ("N m", "N*m"),
    ("N.m", "N*m"),
    ("N-m", "N*m"),
    ("kNm", "kN*m"),
    ("kN m", "kN*m"),
    ("kN.m", "kN*m"),
    ("Ncm", "N*cm"),
    ("N cm", "N*cm"),
    ("Nmm", "N*mm"),
    ("N mm", "N*mm"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("rpm", "rpm"),
    ("rad", "rad"),
    ("degrees", "deg"),
    ("degree", "deg"),
];

/// The digit of ASCII for one of Persian or Arabic.
fn plain_digit(sign: char) -> Option<char> {
    let zero = match sign {
        '\u{660}'..='\u{669}' => '\u{660}',
        '\u{6f0}'..='\u{6f9}' => '\u{6f0}',
        _ => return None,
    };
    char::from_digit(u32::from(sign).saturating_sub(u32::from(zero)), 10)
}

/// The same outside of the texts of a JSON file, where numbers stand bare.
pub(super) fn with_plain_numbers(json: &str) -> Cow<'_, str> {
    let mut plain = String::new();
    let mut from = 0;
    let (mut quoted, mut escaped) = (false, false);
    for (at, sign) in json.char_indices() {
        match (quoted, sign) {
            (true, _) if escaped => escaped = false,
            (true, '\\') => escaped = true,
            (_, '"') => {
                let part = &json[from..at];
                plain.push_str(&if quoted { Cow::Borrowed(part) } else { with_plain_digits(part) });
                from = at;
                quoted = !quoted;
            }
            _ => {}
        }
    }
    plain.push_str(&with_plain_digits(&json[from..]));
    if plain == json { Cow::Borrowed(json) } else { Cow::Owned(plain) }
}

/// Refuses a number with a decimal comma.
pub(super) fn refuse_decimal_comma(text: &str, at: usize) -> Res<()> {
    if !has_decimal_comma(text) {
        return Ok(());
    }
    // Between thousands as well as before decimals: nobody but the writer knows.
    let number: &str = text.split_whitespace().next().unwrap_or(text);
    let parts: Vec<&str> = number.split(',').skip(1).collect();
    if parts.iter().all(|part| part.len() == 3 && part.bytes().all(|sign| sign.is_ascii_digit())) {
        let fault = Fault::new(at, format!("`{text}` has a comma, which may part thousands or decimals"));
        let thousands = text.replace(',', "");
        return Err(match parts.len() {
            1 => fault.mend(format!("write {thousands}, or {}", text.replacen(',', ".", 1))),
            _ => fault.mend(format!("write {thousands}")),
        });
    }
    let fault = Fault::new(at, format!("`{text}` has a decimal comma"));
    Err(fault.mend(format!("write a decimal point: {}", text.replacen(',', ".", 1))))
}

/// Whether a text begins with a number that has a decimal comma.
fn has_decimal_comma(text: &str) -> bool {
    let text = text.trim().trim_start_matches(['+', '-']);
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(text);
    let rest = text.get(whole..).unwrap_or_default();
    whole > 0 && rest.strip_prefix(',').is_some_and(|decimals| digits(decimals) > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_of_persian_and_arabic_are_digits() {
        assert_eq!(with_plain_digits("۱۲۳٫۴۵ in/s"), "123.45 in/s");
        assert_eq!(with_plain_digits("-١٬٢٣٤٫٥"), "-1234.5");
        assert!(matches!(with_plain_digits("v(B),3.5"), Cow::Borrowed(_)));
        assert_eq!(with_plain_digits("نام ٬ ۷"), "نام ٬ 7");
    }

    #[test]
    fn signs_and_senses_as_people_type_them() {
        assert_eq!(with_plain_digits("\u{2212}7.75 in/s"), "-7.75 in/s");
        assert_eq!(with_plain_digits("\u{2212}٧٫٧٥"), "-7.75");
        assert_eq!(with_plain_digits("3\u{2013}4"), "3\u{2013}4");
        assert_eq!(with_plain_digits("30.5°"), "30.5 deg");
        for (typed, plain) in [
            ("12.2 rad/s clockwise", "12.2 rad/s cw"),
            ("12.2 rad/s counter-clockwise", "12.2 rad/s ccw"),
            ("12.2 rad/s Counter Clockwise", "12.2 rad/s ccw"),
            ("12.2 rad/s anticlockwise", "12.2 rad/s ccw"),
            ("CW", "cw"),
            ("5 CCW", "5 ccw"),
            ("5 xcw", "5 xcw"),
            ("5 rad/s بعكس عقارب الساعة", "5 rad/s ccw"),
            ("5 rad/s مع عقارب الساعة", "5 rad/s cw"),
            ("5 rad/s پادساعتگرد", "5 rad/s ccw"),
            ("5 rad/s ساعتگرد", "5 rad/s cw"),
            ("5 rad/s ↻", "5 rad/s cw"),
        ] {
            assert_eq!(with_plain_sense(typed), plain);
        }
    }

    #[test]
    fn units_as_people_write_them() {
        for (typed, plain) in [
            ("117 Nm cw", "117 N*m cw"),
            ("117 N m", "117 N*m"),
            ("1.2 kNm", "1.2 kN*m"),
            ("117 N.m ccw", "117 N*m ccw"),
            ("30 Ncm", "30 N*cm"),
            ("5 rad/sec", "5 rad/s"),
            ("5 m/sec^2", "5 m/s^2"),
            ("5 1/s", "5 rad/s"),
            ("5 s^-1", "5 rad/s"),
            ("5 s⁻²", "5 rad/s^2"),
            ("5 m s^-2", "5 m/s^2"),
            ("120 RPM", "120 rpm"),
            ("5 Rad/s", "5 rad/s"),
            ("Nm", "N*m"),
            ("5 nm", "5 nm"),
            ("5 N·m", "5 N·m"),
            ("5 parsec", "5 parsec"),
            ("v(B)", "v(B)"),
        ] {
            assert_eq!(with_plain_unit(typed), plain);
        }
    }

    #[test]
    fn a_decimal_comma_is_known() {
        assert!(has_decimal_comma("3,5") && has_decimal_comma("-12,25 m/s"));
        assert!(!has_decimal_comma("3.5") && !has_decimal_comma("3, 4") && !has_decimal_comma("a,5"));
    }
}
