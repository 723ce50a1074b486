use super::meaning::without_numbers;

#[test]
fn numbers_are_told_from_the_digits_of_names() {
    for (text, bare) in [
        ("V_B2A = 37.5 cm/s", "V_B2A = # cm/s"),
        ("−1.5e", "#e"),
        ("1 : 10", "# : #"),
        ("ω2 = 4,397 rad/s", "ω2 = # rad/s"),
        ("θ2 = ۳۰°", "θ2 = #°"),
        ("a − b", "a − b"),
        ("O22 and 3", "O22 and #"),
        ("", ""),
    ] {
        assert_eq!(without_numbers(text), bare);
    }
}
