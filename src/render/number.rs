//! The one formatter of coordinates.

use std::fmt::Write;

/// `value` with at most `decimals` decimals: no exponent, no `-0`, no trailing zeros, the same bytes
/// on every machine. What is not finite is written as 0; no module lets it come this far.
#[must_use]
pub fn decimal(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "0".to_owned();
    }
    let mut text = String::new();
    match TENS.get(decimals).and_then(|ten| rounded(value.abs() * ten)) {
        Some(digits) => push_digits(&mut text, value < 0.0, digits, decimals),
        None => push_exactly(&mut text, value, decimals),
    }
    text
}

/// Powers of ten of the decimals that coordinates have.
const TENS: [f64; 7] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// The nearest whole number, where the rounding of `scaled` (half a unit in its last place: below 2³² less than
/// 2⁻²¹) leaves no doubt of it.
fn rounded(scaled: f64) -> Option<u64> {
    if scaled >= 4_294_967_296.0 {
        return None;
    }
    let whole = scaled as u64;
    let rest = scaled - whole as f64;
    if (rest - 0.5).abs() < 1e-6 { None } else { Some(if rest > 0.5 { whole + 1 } else { whole }) }
}

/// Adds a number of so many decimals, without trailing zeros.
fn push_digits(text: &mut String, negative: bool, digits: u64, decimals: usize) {
    let mut unit = (0..decimals).fold(1, |unit, _| 10 * unit);
    if negative && digits > 0 {
        text.push('-');
    }
    push_whole(text, digits / unit);
    let mut rest = digits % unit;
    if rest > 0 {
        text.push('.');
    }
    while rest > 0 {
        unit /= 10;
        push_whole(text, rest / unit);
        rest %= unit;
    }
}

fn push_whole(text: &mut String, whole: u64) {
    if whole >= 10 {
        push_whole(text, whole / 10);
    }
    text.push(char::from(b'0' + (whole % 10) as u8));
}

/// The same for numbers that are large, or half-way between two roundings.
fn push_exactly(text: &mut String, value: f64, decimals: usize) {
    let from = text.len();
    let _ = write!(text, "{value:.decimals$}");
    if text[from..].contains('.') {
        let kept = text.trim_end_matches('0').trim_end_matches('.').len();
        text.truncate(kept);
    }
    if &text[from..] == "-0" {
        text.truncate(from);
        text.push('0');
    }
}

#[cfg(test)]
mod tests {
    use super::decimal;

    #[test]
    fn short_and_plain() {
        for (value, decimals, text) in [
            (1.0, 3, "1"),
            (0.1 + 0.2, 3, "0.3"),
            (-0.0001, 3, "0"),
            (-0.0, 6, "0"),
            (1e-9, 6, "0"),
            (1.25e7, 3, "12500000"),
            (-12.3456789, 6, "-12.345679"),
            (100.0, 0, "100"),
            (f64::NAN, 3, "0"),
            (f64::INFINITY, 3, "0"),
        ] {
            assert_eq!(decimal(value, decimals), text);
        }
    }

    #[test]
    fn the_quick_way_and_the_exact_one_write_the_same() {
        for i in -4000..4000 {
            for value in [f64::from(i) * 0.000_5, f64::from(i) * 0.731_234_567, f64::from(i) * 1.0e6 / 7.0] {
                for decimals in [0, 3, 6] {
                    let mut exact = String::new();
                    super::push_exactly(&mut exact, value, decimals);
                    assert_eq!(decimal(value, decimals), exact, "{value}");
                }
            }
        }
    }

    #[test]
    fn reads_back_within_half_a_unit_of_the_last_decimal() {
        for i in 0..1000 {
            let value = (f64::from(i) - 500.0) * 0.731_234_567;
            let read: f64 = decimal(value, 6).parse().unwrap();
            assert!((read - value).abs() <= 0.500_001e-6);
        }
    }
}
