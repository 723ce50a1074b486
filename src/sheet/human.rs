//! Numbers as a person writes them: three or four significant figures, a true minus, units upright.

use super::rich::Rich;
use crate::mechanism::quantity::Unit;

/// Three significant figures, four from a thousand on; powers of ten beyond six digits. What is exactly
/// a shorter number is written as one: 45, not 45.0.
#[must_use]
pub fn number(value: f64) -> Rich {
    let short: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if (short - value).abs() <= 1e-9 * value.abs() {
        return figures(value, 3, true);
    }
    computed(value, usual_figures(value)).0
}

/// The same of a number to which lines have come, which stands for another: only what that is exactly is a shorter number.
#[must_use]
pub fn number_told(told: f64, exact: f64) -> Rich {
    let short: f64 = format!("{exact:.2e}").parse().unwrap_or(exact);
    if (short - exact).abs() <= 1e-9 * exact.abs() {
        return number(told);
    }
    computed(told, usual_figures(told)).0
}

/// Whether what [`number_told`] writes is another number than the exact one, in the figures that stand there.
pub fn is_off(told: f64, exact: f64) -> bool {
    let digits = without_a_tie(told, usual_figures(told));
    let written = computed(told, usual_figures(told)).1;
    (written - exact).abs() > 0.5 * (1.0 + 1e-6) * unit_in_the_last(written, digits)
}

/// A number with so many figures, or one more where it needs it, and the number that then stands there.
fn computed(value: f64, digits: usize) -> (Rich, f64) {
    let digits = without_a_tie(value, digits);
    let value = off_the_tie(value, digits);
    let written = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    (figures(value, digits, false), written)
}

/// Whether a number lies half way between two of so many figures.
fn is_half_way(value: f64, digits: usize) -> bool {
    let written: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    let half = 0.5 * unit_in_the_last(value, digits);
    ((value - written).abs() - half).abs() <= 1e-6 * half
}

/// So many figures, or one more where the number lies half way between two of so many: rounded up or down it would be what
/// somebody else does not get. A fifth figure nobody reads: there half way goes up, as everybody rounds.
fn without_a_tie(value: f64, digits: usize) -> usize {
    digits + usize::from(digits < READ_FIGURES && is_half_way(value, digits))
}

/// A number that is written with so many figures; what lies half way is moved off it, away from zero.
fn off_the_tie(value: f64, digits: usize) -> f64 {
    if !is_half_way(value, digits) {
        return value;
    }
    value + libm::copysign(0.1 * unit_in_the_last(value, digits), value)
}

/// A unit of the last place of a number of so many figures.
fn unit_in_the_last(value: f64, digits: usize) -> f64 {
    libm::exp10(libm::floor(libm::log10(value.abs())) - (digits as f64 - 1.0))
}

/// A unit of the last figure in which [`number`] writes a value.
pub(super) fn last_place(value: f64) -> f64 {
    unit_in_the_last(value, usual_figures(value))
}

/// What [`number`] writes with so many figures more, and the number that then stands there. A number that is exactly a
/// shorter one has no more.
pub(super) fn finer(value: f64, more: usize) -> (Rich, f64) {
    let short: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if (short - value).abs() <= 1e-9 * value.abs() {
        return (figures(value, 3, true), short);
    }
    computed(value, usual_figures(value) + more)
}

/// Three figures, four from a thousand on.
fn usual_figures(value: f64) -> usize {
    if value.abs() >= 1000.0 { 4 } else { 3 }
}

/// Whether a number, rounded as [`number`] rounds, or with so many figures more, is what stands there for `result`.
fn rounds_to(reckoned: f64, result: f64, more: usize) -> bool {
    agrees(reckoned, finer(result, more).1, result, more)
}

/// More figures than this no line needs to close.
const GUARDS: usize = 4;

/// The factors of a line with as many figures as it takes for what is computed from them, as they are printed, to be the
/// printed result.
pub fn closing<const N: usize>(
    factors: [f64; N],
    result: f64,
    reckon: impl Fn([f64; N]) -> f64,
) -> [Rich; N] {
    let with = |more: usize| factors.map(|factor| finer(factor, more));
    let closes = |more: &usize| rounds_to(reckon(with(*more).map(|(_, written)| written)), result, 0);
    let more = (0..=GUARDS).find(closes).unwrap_or(0);
    with(more).map(|(text, _)| text)
}

/// The same of as many factors as there are; a difference of nearly equal products takes more figures.
pub fn closing_all(factors: &[f64], result: f64, reckon: impl Fn(&[f64]) -> f64) -> Vec<Rich> {
    /// A double has no more.
    const MOST: usize = 9;
    let with = |more: usize| factors.iter().map(move |factor| finer(*factor, more));
    let closes = |more: &usize| {
        let written: Vec<f64> = with(*more).map(|(_, written)| written).collect();
        rounds_to(reckon(&written), result, 0)
    };
    let more = (0..=MOST).find(closes).unwrap_or(0);
    with(more).map(|(text, _)| text).collect()
}

/// A reading on paper, and what it is by the scale: to the tenth of a millimetre, or with as many of its four figures more as
/// it takes for the product to be the printed one, a fifth as a guard; what then lies half way is read a hundredth further off.
/// With so many figures more than usual; and the number that then stands there.
pub fn reading_at(mm: f64, factor: f64, result: f64, more: usize) -> (Rich, Rich, f64) {
    read_with(mm, factor, result, read_figures(result, more))
}

/// The same of a length that is measured on the skeleton: as a guard it has five figures.
pub fn measured_at(mm: f64, factor: f64, result: f64, more: usize) -> (Rich, Rich, f64) {
    match more {
        AS_A_GUARD => read_with(mm, factor, result, MOST_FIGURES.saturating_sub(usual_figures(result))),
        _ => reading_at(mm, factor, result, more),
    }
}

fn read_with(mm: f64, factor: f64, result: f64, more: usize) -> (Rich, Rich, f64) {
    let (wanted, written) = limited(result, more);
    if let Some(reading) = reading_as(mm, factor, written, more) {
        return (reading, wanted, written);
    }
    // No ruler reads finer: the result is that of what was read.
    let decimals = finest(mm);
    let read = at_decimals(mm, decimals);
    let (amount, written) = limited(read * factor, more);
    (with_unit(&Rich::upright(fixed(read, decimals)), "mm"), amount, written)
}

/// A reading on paper and all figures of what it is by the scale, with the number that then stands there; none where these are
/// more than five, as in inches. What is computed from a length that was measured needs no guard then.
pub fn reading_exactly(mm: f64, factor: f64, more: usize) -> Option<(Rich, Rich, f64)> {
    const MOST: usize = 5;
    // A short length has as many figures more as a long one.
    let finest = finest(mm);
    let of_short = (2 + more) as f64 - libm::floor(libm::log10(mm));
    // Written so that a length of nothing is read as finely as one is read.
    let short = (1 + more..finest).find(|decimals| *decimals as f64 >= of_short).unwrap_or(finest);
    let decimals = if more == 0 { 1 } else { short };
    let read = at_decimals(mm, decimals);
    let product = read * factor;
    let written: f64 = format!("{product:.*e}", MOST - 1).parse().ok()?;
    let is_all = (written - product).abs() <= 1e-9 * written.abs();
    let reading = with_unit(&Rich::upright(fixed(read, decimals)), "mm");
    is_all.then(|| (reading, figures(written, MOST, true), written))
}

/// The same as the other of the two numbers of four figures between which the result lies; none where no reading gives it.
pub fn reading_beside(mm: f64, factor: f64, result: f64, more: usize) -> Option<(Rich, Rich, f64)> {
    let more = read_figures(result, more);
    let other = other_neighbour(limited(result, more).1, result, usual_figures(result) + more);
    let (wanted, written) = limited(other, more);
    Some((reading_as(mm, factor, written, more)?, wanted, written))
}

/// Of the two numbers of so many figures between which a value lies the one that is not its rounding.
pub fn other_neighbour(written: f64, value: f64, digits: usize) -> f64 {
    let place = unit_in_the_last(value, digits);
    if written > value { written - place } else { written + place }
}

/// How many figures a reading has for this result with so many more than usual.
pub fn figures_of_reading(result: f64, more: usize) -> usize {
    usual_figures(result) + read_figures(result, more)
}

/// So many figures more than usual stand for a guard: a fifth figure of what is computed or measured on the skeleton, that only
/// keeps what follows from being rounded twice.
pub const AS_A_GUARD: usize = 3;

/// Nobody reads five figures.
fn read_figures(result: f64, more: usize) -> usize {
    more.min(READ_FIGURES.saturating_sub(usual_figures(result)))
}

/// With how many decimals a length on paper is read at most, mm.
fn finest(mm: f64) -> usize {
    match mm {
        mm if mm < 0.1 * DECIMETRE => 3,
        mm if mm < DECIMETRE => 2,
        _ => 1,
    }
}

fn at_decimals(mm: f64, decimals: usize) -> f64 {
    format!("{mm:.decimals$}").parse().unwrap_or(mm)
}

/// The reading of a length that gives this number by the scale, if one does.
fn reading_as(mm: f64, factor: f64, written: f64, more: usize) -> Option<Rich> {
    let finest = finest(mm);
    let to = |decimals: usize| at_decimals(mm, decimals);
    let beside = |decimals: usize| {
        let place = libm::exp10(-(decimals as f64));
        if to(decimals) > mm { to(decimals) - place } else { to(decimals) + place }
    };
    let near = (1..=finest).flat_map(|decimals| {
        let other = (decimals > 1).then(|| beside(decimals));
        [to(decimals)].into_iter().chain(other).map(move |read| (read, decimals))
    });
    // A guard figure, where nothing else gives the result; half way it is read a unit further off, as the others are.
    let guards = (finest < 3).then(|| [to(finest + 1), beside(finest + 1)].map(|read| (read, finest + 1)));
    let near = near.chain(guards.into_iter().flatten());
    let mut closing = near.filter(|(read, _)| agrees(read * factor, written, written, more));
    let (read, decimals) = closing.next()?;
    Some(with_unit(&Rich::upright(fixed(read, decimals)), "mm"))
}

/// Readings on paper as finely as what is reckoned from them needs, to the hundredth of a millimetre at most.
pub fn readings<const N: usize>(mm: [f64; N], result: f64, reckon: impl Fn([f64; N]) -> f64) -> [Rich; N] {
    let (_, written) = finer(result, 0);
    let read = |decimals: usize| mm.map(|mm| format!("{mm:.decimals$}").parse().unwrap_or(mm));
    let decimals = if agrees(reckon(read(1)), written, result, 0) { 1 } else { 2 };
    mm.map(|mm| with_unit(&Rich::upright(fixed(mm, decimals)), "mm"))
}

/// Readings on paper as finely as it takes for what is reckoned from them to round to a number that is printed already, to the
/// thousandth of a millimetre at most: one that is not read finer than all of them are.
pub fn readings_for<const N: usize>(
    mm: [f64; N],
    printed: f64,
    reckon: impl Fn([f64; N]) -> f64,
) -> [Rich; N] {
    const FINEST: usize = 3;
    let text = printed.to_string();
    let place = libm::exp10(-(text.split_once('.').map_or(0, |(_, decimals)| decimals.len()) as f64));
    let read = |decimals: usize| mm.map(|mm| at_decimals(mm, decimals));
    let closes = |decimals: &usize| (reckon(read(*decimals)) - printed).abs() <= 0.5 * place * (1.0 + 1e-9);
    let decimals = (1..=FINEST).find(closes).unwrap_or(FINEST);
    read(decimals).map(|mm| with_unit(&Rich::upright(fixed(mm, decimals)), "mm"))
}

/// Readings of a decimetre and more have one decimal, mm.
const DECIMETRE: f64 = 100.0;
/// More figures than a drawing can give.
const READ_FIGURES: usize = 4;
/// More figures no line carries on.
const MOST_FIGURES: usize = 5;

/// A number with so many figures more than usual, of which there are five at most, and the number that then stands there.
/// Noughts at its end that are more than usual say nothing.
pub fn limited(value: f64, more: usize) -> (Rich, f64) {
    let most = more.min(MOST_FIGURES.saturating_sub(usual_figures(value)));
    let (text, written) = finer(value, most);
    let same = |fewer: &(Rich, f64)| fewer.1 == written;
    (0..most).map(|fewer| finer(value, fewer)).find(same).unwrap_or((text, written))
}

/// What is reckoned from rounded numbers: of more than four figures as many as it has in common with the exact result, for
/// rounded numbers carry no more. Four are a guard for what is computed from it.
pub fn in_common(reckoned: f64, exact: f64, more: usize) -> (Rich, f64) {
    let four = READ_FIGURES.saturating_sub(usual_figures(exact)).min(more);
    let common = (four + 1..=more).rev().find(|more| limited(reckoned, *more).1 == limited(exact, *more).1);
    limited(reckoned, common.unwrap_or(four))
}

/// Whether what is reckoned is, in the figures in which `result` is printed, the number that stands there for it: what lies
/// half way between two of four figures is the larger, what lies half way between two of three is neither.
pub fn agrees(reckoned: f64, written: f64, result: f64, more: usize) -> bool {
    if written == 0.0 || !written.is_finite() {
        return reckoned == written;
    }
    let usual = usual_figures(result);
    let digits = without_a_tie(result, (usual + more).clamp(usual, MOST_FIGURES));
    let halves = (reckoned - written) * written.signum() / (0.5 * unit_in_the_last(written, digits));
    let least = if digits < READ_FIGURES { -1.0 + 1e-6 } else { -1.0 - 1e-6 };
    (least..1.0 - 1e-6).contains(&halves)
}

/// A stated number, as it is written where it is given; of one with more figures than anybody states those of [`limited`].
pub fn given(value: f64, more: usize) -> (Rich, f64) {
    as_stated(value).map_or_else(|| limited(value, more), |number| (stated(value), number))
}

/// A number that has no more figures than somebody states, without the last bits that a change of units leaves.
fn as_stated(value: f64) -> Option<f64> {
    let short: f64 = format!("{value:.*e}", STATED_FIGURES - 1).parse().unwrap_or(value);
    ((short - value).abs() <= 1e-13 * value.abs()).then_some(short)
}

/// A stated number that was calculated, a crank of 70.710678118 mm: what is lost is less than a ten-thousandth part of the
/// size of what is stated. One that somebody wrote down stays as it is.
pub fn rounded_to(value: f64, size: f64) -> f64 {
    /// Finer nobody draws.
    const PART: f64 = 1e-4;
    if as_stated(value).is_some() || size <= 0.0 || !size.is_finite() {
        return value;
    }
    let place = libm::exp10(libm::floor(libm::log10(2.0 * PART * size)));
    // Divided by a whole number a decimal is the double that is next to it.
    if place < 1.0 {
        let whole = libm::round(1.0 / place);
        return libm::round(value * whole) / whole;
    }
    libm::round(value / place) * place
}

/// A printed number in a unit that is a power of ten of its own, and the number that then stands there: its figures stay.
pub fn shifted(number: f64, tens: i32) -> (Rich, f64) {
    let value = format!("{number:.9e}").parse().unwrap_or(number) * libm::exp10(f64::from(tens));
    let written = format!("{value:.5e}").parse().unwrap_or(value);
    (stated(value), written)
}

/// A scale that follows from another and is multiplied with readings: as many of its figures as it needs, at most five; and
/// the number that then stands there.
pub fn factor(value: f64) -> (Rich, f64) {
    let written = format!("{value:.4e}").parse().unwrap_or(value);
    (figures(value, 5, true), written)
}

/// A stated number: all of its figures; of one that was calculated six at most.
#[must_use]
pub fn stated(value: f64) -> Rich {
    figures(value, if as_stated(value).is_some() { STATED_FIGURES } else { 6 }, true)
}

/// More figures nobody states: tenths of a micrometre of metres, 12 11/16 in and finer.
const STATED_FIGURES: usize = 8;

/// A stated coordinate beside another: a small one has its decimals, and no power of ten, where the other has none.
#[must_use]
pub fn stated_beside(value: f64, other: f64) -> Rich {
    /// No more decimals are written out.
    const MOST: usize = 9;
    let exponent = |own: f64| libm::floor(libm::log10(own.abs()));
    let plain = other == 0.0 || (-3.0..6.0).contains(&exponent(other));
    let small = value != 0.0 && exponent(value) < -3.0 && plain;
    let decimals = (5.0 - exponent(value)).clamp(0.0, MOST as f64) as usize;
    let text = fixed(value, decimals);
    // What would lose figures keeps its power.
    let whole: f64 = text.replace('−', "-").parse().unwrap_or(0.0);
    if small && (whole - value).abs() <= 1e-6 * value.abs() {
        return Rich::upright(text.trim_end_matches('0'));
    }
    stated(value)
}

/// A reading on paper: tenths of a millimetre.
#[must_use]
pub fn millimetres(value: f64) -> Rich {
    with_unit(&Rich::upright(fixed(value, 1)), "mm")
}

/// An angle in degrees, one decimal at most; one that is stated with more of them has these wherever it stands. Half a turn
/// has no sign: which it is would be told by a rounding.
#[must_use]
pub fn degrees(radians: f64) -> Rich {
    /// Nearer to a whole number of degrees a direction differs from it by roundings.
    const WHOLE: f64 = 1e-6;
    let value = radians.to_degrees();
    let is_stated = |(decimals, room): &(usize, f64)| {
        let stated: f64 = format!("{value:.decimals$}").parse().unwrap_or(value);
        (stated - value).abs() <= *room
    };
    // Nobody states an angle more finely. With five decimals a calculated one is by chance near to a stated one, where it need
    // not be it to the last bits.
    let stated = [(3, 1e-9), (5, 1e-11)].into_iter().find(is_stated);
    let text = fixed(value, stated.map_or(1, |(decimals, _)| decimals));
    // A nought at the end of what is calculated was found.
    let whole = (value - libm::round(value)).abs() < WHOLE;
    let text =
        if stated.is_some() || whole { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let text =
        if ["−0", "−180", "−0.0", "−180.0"].contains(&text) { &text["−".len()..] } else { text };
    Rich::upright(text).up("°")
}

/// Degrees to a hundredth.
#[must_use]
pub fn hundredths_of_a_degree(radians: f64) -> Rich {
    let text = fixed(radians.to_degrees(), 2);
    Rich::upright(text.trim_end_matches('0').trim_end_matches('.')).up("°")
}

/// A number with its unit.
#[must_use]
pub fn with_unit(number: &Rich, symbol: &str) -> Rich {
    match pretty(symbol).as_str() {
        "" => number.clone(),
        "°" => number.clone().up("°"),
        unit => number.clone().up("\u{a0}").up(unit),
    }
}

/// `cm/s^2` as `cm/s²`.
#[must_use]
pub fn pretty(symbol: &str) -> String {
    symbol.replace("um", "µm").replace("^2", "²").replace("^3", "³").replace('*', "·").replace("deg", "°")
}

/// A value in a unit.
#[must_use]
pub fn quantity(si: f64, unit: &Unit) -> Rich {
    with_unit(&number(si / unit.si), &unit.symbol)
}

/// A stated value in a unit.
#[must_use]
pub fn stated_quantity(si: f64, unit: &Unit) -> Rich {
    with_unit(&stated(si / unit.si), &unit.symbol)
}

/// The length of a speed's unit: mm of mm/s.
#[must_use]
pub fn length_of(speed: &Unit) -> Option<Unit> {
    let lengths: [(&str, f64); 8] = [
        ("nm", 1e-9),
        ("um", 1e-6),
        ("mm", 1e-3),
        ("cm", 1e-2),
        ("m", 1.0),
        ("km", 1e3),
        ("in", 0.0254),
        ("ft", 0.3048),
    ];
    let (symbol, _) = speed.symbol.split_once('/')?;
    let (_, si) = lengths.into_iter().find(|(name, _)| *name == symbol)?;
    Some(Unit { symbol: symbol.to_owned(), si })
}

pub(super) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    let text = if zero { text.trim_start_matches('-').to_owned() } else { text };
    text.replace('-', "−")
}

fn figures(value: f64, digits: usize, trim: bool) -> Rich {
    if value == 0.0 || !value.is_finite() {
        return Rich::upright("0");
    }
    // `{:e}` rounds correctly and says the exponent after rounding (9.996 → 1.00e1).
    let scientific = format!("{value:.*e}", digits - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return Rich::upright(scientific) };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let tidy = |text: String| {
        let short = text.trim_end_matches('0').trim_end_matches('.');
        let text = if trim && text.contains('.') { short.to_owned() } else { text };
        text.replace('-', "−")
    };
    if (-3..6).contains(&exponent) {
        // Whole numbers are not cut below their last digit's place: 12 346 stays 12350 at four figures.
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        let rounded: f64 = scientific.parse().unwrap_or(value);
        Rich::upright(grouped(&tidy(format!("{rounded:.decimals$}"))))
    } else {
        let power = exponent.to_string().replace('-', "−");
        Rich::upright(tidy(mantissa.to_owned())).up("\u{a0}×\u{a0}10").sup(&power)
    }
}

/// Whole digits in groups of three, parted by thin blanks, from five digits on.
fn grouped(text: &str) -> String {
    let whole = text.find('.').unwrap_or(text.len());
    let digits = text[..whole].chars().filter(char::is_ascii_digit).count();
    if digits < 5 {
        return text.to_owned();
    }
    let mut left = digits;
    let mut out = String::new();
    for c in text[..whole].chars() {
        if c.is_ascii_digit() {
            if left < digits && left.is_multiple_of(3) {
                out.push('\u{2009}');
            }
            left -= 1;
        }
        out.push(c);
    }
    out + &text[whole..]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(rich: &Rich) -> String {
        rich.set(4.0).text.content()
    }

    #[test]
    fn units_are_written_as_in_print() {
        assert_eq!([pretty("um"), pretty("um/s^2"), pretty("mm")], ["µm", "µm/s²", "mm"]);
    }

    #[test]
    fn significant_figures() {
        for (value, text) in [
            (175.309, "175"),
            (4.397, "4.40"),
            (-43.427, "−43.4"),
            (1442.943, "1443"),
            (999.6, "1000"),
            (0.0538, "0.0538"),
            (12_345.6, "12\u{2009}350"),
            // Half way between two: neither up nor down.
            (562.5, "562.5"),
            (-0.012_45, "−0.01245"),
            (22.25, "22.25"),
            (562.500_1, "563"),
            // Of four figures it goes up.
            (1657.5, "1658"),
            (-4002.5, "−4003"),
            (-214_200.0, "−214\u{2009}200"),
            (1.26e6, "1.26\u{a0}×\u{a0}106"),
            (-2.511e-7, "−2.51\u{a0}×\u{a0}10−7"),
            (-2.51154e-7, "−2.51\u{a0}×\u{a0}10−7"),
            (45.0, "45"),
            (0.3 / 0.01, "30"),
            (0.0, "0"),
        ] {
            assert_eq!(plain(&number(value)), text);
        }
        assert_eq!(plain(&number_told(27.0, 26.98)), "27.0");
        assert_eq!(plain(&number_told(27.0, 27.0)), "27");
        assert_eq!(plain(&number_told(0.6376, 0.6374)), "0.638");
        assert_eq!(plain(&stated(15.0)), "15");
        assert_eq!(plain(&stated(37.5)), "37.5");
        assert_eq!(plain(&stated(0.15 / 0.01)), "15");
        assert_eq!(plain(&stated_beside(-0.0004, 0.1916)), "−0.0004");
        assert_eq!(plain(&stated_beside(-0.000_632_138, -0.185_723)), "−0.000632138");
        assert_eq!(plain(&stated_beside(0.1916, -0.0004)), "0.1916");
        assert_eq!(plain(&stated_beside(0.0, 5.0)), "0");
        assert_eq!(plain(&stated_beside(-0.0004, 0.0)), "−0.0004");
        assert_eq!(plain(&stated(rounded_to(5000.0_f64.sqrt(), 100.0))), "70.71");
        assert_eq!(plain(&stated(rounded_to(18_185.0_f64.sqrt(), 400.0))), "134.85");
        // What somebody wrote down stays as it is: sixteenths of an inch, tenths of a micrometre.
        assert_eq!(plain(&stated(rounded_to(12.6875 * 0.0254 / 0.0254, 20.0))), "12.6875");
        assert_eq!(plain(&stated(rounded_to(0.130_987_65 / 1e-3, 400.0))), "130.98765");
        assert_eq!(plain(&given(1401.25 * 1e-3 / 1e-3, 0).0), "1401.25");
        assert_eq!(plain(&degrees(38.0475_f64.to_radians())), "38.0475°");
        assert_eq!(plain(&degrees(12.345_67_f64.to_radians())), "12.34567°");
        assert_eq!(plain(&stated(rounded_to(1234.5, 2000.0))), "1234.5");
        assert_eq!(plain(&given(5000.0_f64.sqrt(), 0).0), "70.7");
        assert_eq!(plain(&stated_beside(2.5e-8, 3e-8)), "2.5\u{a0}×\u{a0}10−8");
        assert_eq!(plain(&stated_beside(1.2345e-7, 0.5)), "1.2345\u{a0}×\u{a0}10−7");
    }

    #[test]
    fn printed_factors_give_the_printed_result() {
        // 317² / 80 = 1256, and the true speed is 317.2.
        let [speed, length] = closing([317.2, 80.0], 317.2 * 317.2 / 80.0, |[v, l]| v * v / l);
        assert_eq!((plain(&speed), plain(&length)), ("317.2".to_owned(), "80".to_owned()));
        let [speed, _] = closing([317.04, 80.0], 317.04 * 317.04 / 80.0, |[v, l]| v * v / l);
        assert_eq!(plain(&speed), "317");
        // 35.1 × 5 is 175.5, half way to 175: it is read more finely.
        let line = |mm: f64, factor: f64| {
            let (mm, amount, _) = reading_at(mm, factor, factor * mm, 0);
            [mm, amount].map(|part| plain(&part))
        };
        assert_eq!(line(35.062, 5.0), ["35.06\u{a0}mm", "175"]);
        // Where it cannot be, half way goes up.
        assert_eq!(line(682.504, 5.0), ["682.5\u{a0}mm", "3413"]);
        // 63.50 × 5 is half way between two of three figures: it is read a hundredth further off.
        assert_eq!(line(63.496, 5.0), ["63.49\u{a0}mm", "317"]);
        assert_eq!(line(30.0, 5.0), ["30.0\u{a0}mm", "150"]);
        // 57.4 × 50 is not 2871, 57.43 × 50 half way to it.
        assert_eq!(line(57.426, 50.0), ["57.42\u{a0}mm", "2871"]);
        assert_eq!(line(106.46, 50.0), ["106.46\u{a0}mm", "5323"]);
        // So is the guard: 120.4 × 50 is not 6022, 120.45 × 50 half way to the next.
        assert_eq!(line(120.448, 50.0), ["120.44\u{a0}mm", "6022"]);
        // Four figures are read, the fourth of less than a centimetre too.
        assert_eq!(line(6.826, 5000.0), ["6.826\u{a0}mm", "34\u{2009}130"]);
        // Noughts that are more than usual say nothing.
        assert_eq!(plain(&limited(628.301, 2).0), "628.3");
        assert_eq!(plain(&limited(2136.0, 1).0), "2136");
    }

    #[test]
    fn units_are_upright_and_angles_have_no_blank() {
        assert_eq!(plain(&with_unit(&number(2.0), "cm/s^2")), "2\u{a0}cm/s²");
        assert_eq!(plain(&degrees(std::f64::consts::FRAC_PI_6)), "30°");
        assert_eq!(plain(&degrees(-1e-9)), "0°");
        // An angle that is stated so, however it came to radians.
        assert_eq!(plain(&degrees(-99.55_f64.to_radians())), "−99.55°");
        assert_eq!(plain(&degrees(-99.552_3_f64.to_radians())), "−99.5523°");
        // One that was calculated.
        assert_eq!(plain(&degrees(-1.7375)), "−99.6°");
        assert_eq!(plain(&degrees(std::f64::consts::PI)), "180°");
    }
}
