//! The digits of Persian and Arabic in answers, as those that the readers know.

use std::borrow::Cow;

use crate::scene::diagnostic::{Fault, Res};

/// The same text with the digits of ASCII, `٫` as the decimal point and `٬` left out between digits.
#[must_use]
pub(crate) fn with_plain_digits(text: &str) -> Cow<'_, str> {
    if !text.chars().any(|sign| plain_digit(sign).is_some() || matches!(sign, DECIMAL | THOUSANDS)) {
        return Cow::Borrowed(text);
    }
    let is_digit =
        |sign: Option<char>| sign.is_some_and(|sign| sign.is_ascii_digit() || plain_digit(sign).is_some());
    let mut plain = String::with_capacity(text.len());
    let mut before = None;
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let between = is_digit(before) && is_digit(signs.peek().copied());
        match (sign, plain_digit(sign)) {
            (_, Some(digit)) => plain.push(digit),
            (DECIMAL, _) => plain.push('.'),
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
    fn a_decimal_comma_is_known() {
        assert!(has_decimal_comma("3,5") && has_decimal_comma("-12,25 m/s"));
        assert!(!has_decimal_comma("3.5") && !has_decimal_comma("3, 4") && !has_decimal_comma("a,5"));
    }
}
