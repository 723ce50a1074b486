//! The one formatter of coordinates.

/// `value` with at most `decimals` decimals: no exponent, no `-0`, no trailing zeros, the same bytes
/// on every machine. What is not finite is written as 0; no module lets it come this far.
#[must_use]
pub fn decimal(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "0".to_owned();
    }
    let mut text = format!("{value:.decimals$}");
    if text.contains('.') {
        let kept = text.trim_end_matches('0').trim_end_matches('.').len();
        text.truncate(kept);
    }
    if text == "-0" { "0".to_owned() } else { text }
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
    fn reads_back_within_half_a_unit_of_the_last_decimal() {
        for i in 0..1000 {
            let value = (f64::from(i) - 500.0) * 0.731_234_567;
            let read: f64 = decimal(value, 6).parse().unwrap();
            assert!((read - value).abs() <= 0.500_001e-6);
        }
    }
}
