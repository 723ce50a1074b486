//! A report for the student who handed in: his answers as he wrote them, one sentence for each fault, marks.

use std::fmt::Write as _;

use super::answers::Form;
use super::judge::{CLOSE, Mistake, Verdict};
use super::phrase::{Phrase, say};
use super::report::{Allowed, Amiss, Graded, Report, UnstatedScale};
use super::symbols::Symbols;
use crate::mechanism::quantity::Order;
use crate::sheet::Language;

impl Verdict {
    /// What a student is told.
    #[must_use]
    pub fn told(self) -> Phrase {
        match self {
            Self::Right => say!("right"),
            Self::Consistent => say!("follows rightly from another fault"),
            Self::Wrong => say!("wrong"),
            Self::NotChecked => say!("not determined here"),
        }
    }
}

impl Graded {
    /// What was handed in, in the form and with the digits in which it was written.
    #[must_use]
    pub fn handed_in(&self) -> Phrase {
        let written = if self.rounding > 0.0 { 2.0 * self.rounding } else { 0.0 };
        let finest = if written > 0.0 { written } else { self.tolerance / 10.0 };
        self.told(&self.given, finest, Within::Left)
    }

    /// What is right, in the same form, to three figures at least.
    #[must_use]
    pub fn expected(&self) -> Phrase {
        self.told(&self.right, self.finest(), Within::Left)
    }

    /// The same with the tolerances: of a vector one of the magnitude and one of the direction.
    #[must_use]
    pub fn expected_within(&self) -> Phrase {
        self.told(&self.right, self.finest(), Within::Told)
    }

    /// To which part of its value the right number is told.
    fn finest(&self) -> f64 {
        let size = self.right.iter().fold(0.0, |sum, x| libm::hypot(sum, *x));
        if size <= 0.0 {
            return self.tolerance;
        }
        self.tolerance.min(libm::pow(10.0, libm::floor(libm::log10(size)) - 2.0))
    }

    /// Which part of it is wrong, where it has parts.
    fn parts_amiss(&self) -> Amiss {
        self.turn.map_or(Amiss::default(), |_| self.amiss)
    }

    /// What is said of it in a word or two.
    #[must_use]
    pub fn judged(&self) -> Phrase {
        let verdict = match (self.verdict, self.parts_amiss()) {
            (Verdict::Wrong, Amiss { size: true, direction: true }) => say!("wrong: magnitude and direction"),
            (Verdict::Wrong, Amiss { size: true, .. }) => say!("wrong: the magnitude"),
            (Verdict::Wrong, Amiss { direction: true, .. }) => say!("wrong: the direction"),
            (verdict, _) => verdict.told(),
        };
        match self.charged {
            true => say!("{}, which costs its mark here", verdict),
            false => self.with_what_is_untold(verdict),
        }
    }

    /// The same, with what is not told of the answer.
    fn with_what_is_untold(&self, verdict: Phrase) -> Phrase {
        match self.silent() {
            Some("sense") => say!("{}, but its sense is not told", verdict),
            Some(_) => say!("{}, but its direction is not told", verdict),
            None => verdict,
        }
    }

    /// What is not told of an answer that is right or follows rightly, as far as it goes.
    #[must_use]
    pub fn silent(&self) -> Option<&'static str> {
        let holds = matches!(self.verdict, Verdict::Right | Verdict::Consistent);
        self.untold.filter(|_| holds && self.right.iter().any(|right| right.abs() > self.tolerance))
    }

    /// Why it may be off by that.
    #[must_use]
    pub fn because(&self) -> Phrase {
        let unit = &self.unit.symbol;
        match self.allowed {
            Allowed::Stated => say!("as the answers' file states it"),
            Allowed::Calculated => say!("calculated from what is given, no reading is behind it"),
            Allowed::Read { mm: Some(mm), of: Some(of) } => {
                let [mm, of] = [digits(mm, mm / 5.0), digits(of, 1.0)];
                say!("read: {} mm of {} mm on paper at that place", mm, of)
            }
            Allowed::Read { .. } => say!("calculated from what is read off the drawing"),
            Allowed::Small { part, most, of_reading: true } => say!(
                "small on paper: two readings off it are {} % of it, so that {} % does not hold",
                (100.0 * part).round(),
                (100.0 * most).round()
            ),
            Allowed::Small { part, most, of_reading: false } => say!(
                "small beside the largest of its kind, and read no finer than a tenth of that: that is {} % of it, so that {} % does not hold",
                (100.0 * part).round(),
                (100.0 * most).round()
            ),
            Allowed::Capped { honest, turn } => {
                let honest = digits(honest, honest / 2.0);
                match turn.map(|turn| digits(turn, turn / 2.0)) {
                    None => say!("hard to measure: a careful hand may be off by {} {} here", honest, unit),
                    Some(turn) => say!(
                        "hard to measure: a careful hand may be off by {} {} and {}° here",
                        honest,
                        unit,
                        turn
                    ),
                }
            }
        }
    }

    /// Numbers in the unit in which the student wrote them: millimetres of what lies on paper.
    fn on_paper<'u>(&'u self, numbers: &[f64]) -> (Vec<f64>, Option<&'u str>) {
        match self.per_mm {
            Some(per_mm) if self.form == Form::Paper && per_mm > 0.0 => {
                (numbers.iter().map(|n| n / per_mm).collect(), None)
            }
            _ => (numbers.to_vec(), Some(&self.unit.symbol)),
        }
    }

    /// Numbers to about a part of `finest`, with their tolerances or without.
    fn told(&self, numbers: &[f64], finest: f64, within: Within) -> Phrase {
        let (numbers, unit) = self.on_paper(numbers);
        let (steps, _) = self.on_paper(&[finest, self.tolerance]);
        let [step, tolerance] = [0, 1].map(|place| steps.get(place).copied().unwrap_or(0.0));
        // A number with its unit.
        let of_unit = |number: String| match unit {
            None => say!("{} mm on paper", number),
            Some(unit) => Phrase::from(format!("{number} {unit}").trim_end()),
        };
        let room = |size: f64| match within {
            Within::Left => String::new(),
            Within::Told => format!(" ± {}", digits(size, size / 10.0)),
        };
        let size = room(tolerance);
        let turn = self.turn.filter(|turn| *turn < HALF_TURN).map_or(String::new(), |turn| match within {
            Within::Left => String::new(),
            Within::Told => format!(" ± {}°", digits(turn, turn / 10.0)),
        });
        match numbers[..] {
            [] => say!("not determined here"),
            [value] => {
                let number = |value: f64| of_unit(format!("{}{size}", digits(value, step)));
                match (self.turns && !self.magnitude_only, value < 0.0) {
                    (false, _) => number(value),
                    (true, true) => say!("{} cw", number(-value)),
                    (true, false) => say!("{} ccw", number(value)),
                }
            }
            [x, y, ..] if self.form == Form::Polar => {
                let length = of_unit(format!("{}{size}", digits(libm::hypot(x, y), step)));
                let direction = trimmed(&digits(libm::atan2(y, x).to_degrees(), 0.1));
                say!("{} at {}°{}", length, direction, turn)
            }
            [x, y, ..] => {
                let both = format!("({}, {})", digits(x, step), digits(y, step));
                // Where a point stands is seen by its figure to be on paper.
                let symbol = unit.unwrap_or("mm");
                let of_unit = |both: String| Phrase::from(format!("{both} {symbol}").trim_end());
                match (within, self.turn) {
                    (Within::Told, None) => of_unit(both + &size),
                    (Within::Left, _) => of_unit(both),
                    (Within::Told, Some(_)) => {
                        let both = of_unit(both);
                        match turn.is_empty() {
                            true => say!("{}, magnitude{} {}", both, size, symbol),
                            false => say!("{}, magnitude{} {}, direction{}", both, size, symbol, turn),
                        }
                    }
                }
            }
        }
    }
}

/// Whether tolerances are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Within {
    Told,
    Left,
}

/// A direction that may be off by this much may be any.
const HALF_TURN: f64 = 180.0;

/// Without a fraction that is nothing.
fn trimmed(number: &str) -> String {
    number.strip_suffix(".0").unwrap_or(number).to_owned()
}

impl Report {
    /// What is told before all answers.
    pub(super) fn notes(&self) -> Vec<Phrase> {
        let turned = self.turned.map(|turned| {
            let by = digits(turned.abs(), 0.1);
            match turned < 0.0 {
                true => say!(
                    "Your drawing lies turned by {}° clockwise; it was turned back before it was compared.",
                    by
                ),
                false => say!(
                    "Your drawing lies turned by {}° counter-clockwise; it was turned back before it was compared.",
                    by
                ),
            }
        });
        let enlarged = self.enlarged.map(|factor| {
            let times = |factor: f64| trimmed(&digits(factor, 0.01));
            match factor < 1.0 {
                true => say!(
                    "Your skeleton is {} times smaller than at the sheet's scale; it was compared at its own.",
                    times(1.0 / factor)
                ),
                false => say!(
                    "Your skeleton is {} times larger than at the sheet's scale; it was compared at its own.",
                    times(factor)
                ),
            }
        });
        let variant = self.other_variant.as_ref().map(|variant| {
            say!(
                "These are the answers of variant {}: the number of the variant is wrong, or they are not the student's own. Nothing follows from them.",
                variant
            )
        });
        let stated = self
            .tolerances_ignored
            .then(|| say!("The tolerance that these answers state does not count: the examiner sets it."));
        let scales = self.scales.iter().map(|UnstatedScale { order, per_mm, unit, own }| {
            let figure = match order {
                Order::Acceleration => say!("the accelerations"),
                _ => say!("the velocities"),
            };
            let per_mm = trimmed(&digits(*per_mm, per_mm / 200.0));
            match own {
                true => say!(
                    "No scale is stated for {}: their lengths agree at {} {} per mm, and were compared at that.",
                    figure,
                    per_mm,
                    unit.symbol
                ),
                false => say!(
                    "No scale is stated for {}: their lengths were compared at the sheet's {} {} per mm.",
                    figure,
                    per_mm,
                    unit.symbol
                ),
            }
        });
        variant.into_iter().chain(turned).chain(enlarged).chain(scales).chain(stated).collect()
    }

    /// A sentence in the language of the report, with names as the sheet prints them.
    pub(super) fn says(&self, phrase: &Phrase) -> String {
        self.symbols.plain(&phrase.told(self.language))
    }

    /// The report as text.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        let mut line = |told: String| {
            let _ = writeln!(text, "{told}");
        };
        if let Some(student) = &self.student {
            line(student.clone());
        }
        for note in self.notes() {
            line(note.told(self.language));
        }
        let rows: Vec<[String; 3]> =
            self.quantities.iter().map(|graded| row(graded, &self.symbols, self.language)).collect();
        let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
        let [a, b] = [width(0), width(1)];
        for (graded, [name, given, verdict]) in self.quantities.iter().zip(&rows) {
            line(format!("{name:<a$}  {given:<b$}  {verdict}"));
            if graded.verdict == Verdict::Wrong && self.other_variant.is_none() {
                line(format!("    {}", self.says(&sentence(graded))));
            }
        }
        if !self.missing.is_empty() {
            line(self.says(&say!("not answered: {}", self.names_of_missing())));
        }
        for one in &self.not_read {
            // Where it stands in the file is the examiner's.
            let (name, why) = (self.symbols.plain(&one.name), one.what_and_mend());
            let told = match one.weight > 0.0 {
                true => say!("not read, no marks: {}: {}", name, why),
                false => say!("not read: {}: {}", name, why),
            };
            line(told.told(self.language));
        }
        if let (Some(fault), None) = (self.first_fault(), &self.other_variant) {
            let told = match fault.step {
                Some(step) => say!("first fault in step {}, {}", step, fault.text()),
                None => say!("first fault, {}", fault.text()),
            };
            line(self.says(&told));
        }
        let (reached, of) = self.sum();
        line(self.says(&say!("marks: {} of {}", marks(reached), marks(of))));
        text
    }

    /// What is asked and was not answered.
    pub(super) fn names_of_missing(&self) -> String {
        let names: Vec<&str> = self.missing.iter().map(|(name, _)| name.as_str()).collect();
        names.join(", ")
    }
}

/// What is said of an answer that no known mistake explains and that is off by no more than a careless hand slips.
fn slip(graded: &Graded) -> Option<Phrase> {
    let (part, turned) = match (&graded.given[..], &graded.right[..]) {
        (&[x, y], &[a, b]) if graded.turn.is_some() => (
            libm::hypot(x, y) / libm::hypot(a, b) - 1.0,
            libm::atan2(a * y - b * x, a * x + b * y).to_degrees(),
        ),
        (&[own], &[right]) => (own / right - 1.0, 0.0),
        _ => return None,
    };
    if !(part.abs() <= super::judge::SLIP.0 && turned.abs() <= super::judge::SLIP.1) {
        return None;
    }
    let (percent, degrees) = ((100.0 * part.abs()).round(), turned.abs().round());
    let Amiss { size, direction } = graded.parts_amiss();
    let size = size || graded.turn.is_none();
    Some(match (size && percent >= 1.0, direction && degrees >= 1.0) {
        (true, true) => say!(
            "No known mistake leads to this value; it is about {} % and {}° off, as by a slip in drawing or reading.",
            percent,
            degrees
        ),
        (false, true) => say!(
            "No known mistake leads to this value; it is about {}° off, as by a slip in drawing or reading.",
            degrees
        ),
        (true, false) if part > 0.0 => say!(
            "No known mistake leads to this value; it is about {} % too large, as by a slip in drawing or reading.",
            percent
        ),
        (true, false) => say!(
            "No known mistake leads to this value; it is about {} % too small, as by a slip in drawing or reading.",
            percent
        ),
        (false, false) => return None,
    })
}

/// What is said of a wrong answer: what it probably is, and where to look.
pub(super) fn sentence(graded: &Graded) -> Phrase {
    let Some(mistake) = graded.mistakes.first() else {
        if let Some(slip) = slip(graded) {
            return slip;
        }
        return match graded.step {
            Some(step) => say!(
                "No known mistake leads to this value; compare your drawing from step {} of the solution on.",
                step
            ),
            None => say!("No known mistake leads to this value; compare your drawing."),
        };
    };
    let told = |mistake: &Mistake| match mistake.step.or(graded.step) {
        Some(step) => say!("{} (step {} of the solution)", mistake.own_text(), step),
        None => mistake.own_text(),
    };
    // What comes near by a value that is no mistake of its own is no more than possible.
    let likely = mistake.parts().all(|part| part.residual <= CLOSE);
    let (first, look) = (told(mistake), mistake.look());
    let Some(also) = &mistake.also else {
        return if likely {
            say!("Probably {}. {}", first, look)
        } else {
            say!("Perhaps {}. {}", first, look)
        };
    };
    let both = say!("{}; and {}", first, told(also));
    let looks = if also.look() == look { look } else { say!("{} {}", look, also.look()) };
    match likely {
        true => say!("Probably two mistakes at once: {}. {}", both, looks),
        false => say!("Perhaps two mistakes at once: {}. {}", both, looks),
    }
}

fn row(graded: &Graded, symbols: &Symbols, language: Language) -> [String; 3] {
    let verdict = match (graded.verdict, graded.parts_amiss()) {
        (Verdict::Right, _) if graded.beyond => {
            say!("right as far as it can be measured ({})", graded.expected_within())
        }
        (Verdict::Right, _) => say!("right ({})", graded.expected_within()),
        (Verdict::Wrong, Amiss { size: true, direction: true }) => {
            say!("wrong in magnitude and direction: {} is right", graded.expected_within())
        }
        (Verdict::Wrong, Amiss { size: true, .. }) => {
            say!("wrong in the magnitude: {} is right", graded.expected_within())
        }
        (Verdict::Wrong, Amiss { direction: true, .. }) => {
            say!("wrong in the direction: {} is right", graded.expected_within())
        }
        (Verdict::Wrong, _) => say!("wrong: {} is right", graded.expected_within()),
        (Verdict::Consistent, _) => {
            say!("follows rightly from another fault ({} is right)", graded.expected())
        }
        (Verdict::NotChecked, _) => Verdict::NotChecked.told(),
    };
    let verdict = match (graded.asked, graded.share < 1.0) {
        _ if graded.charged => say!("{}, which costs its mark here", verdict),
        (false, _) => say!("{}, no marks", verdict),
        (true, true) if graded.verdict == Verdict::Wrong && graded.reached() > 0.0 => {
            say!("{}, with marks for the part that is right", verdict)
        }
        _ => graded.with_what_is_untold(verdict),
    };
    [symbols.plain(&graded.name), graded.handed_in().told(language), verdict.told(language)]
}

/// Marks as people write them.
pub(super) fn marks(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// So many digits stand behind no number.
const MOST_DIGITS: f64 = 6.0;

/// A number to the decimal place of `finest`, never to more than six digits.
pub(super) fn digits(value: f64, finest: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let first = libm::floor(libm::log10(value.abs()));
    let place = if finest > 0.0 { libm::floor(libm::log10(finest) + LITTLE) } else { first - 3.0 };
    // What is nothing beside its tolerance is zero.
    if first < place - 1.0 {
        return "0".to_owned();
    }
    let place = place.clamp(first - MOST_DIGITS + 1.0, first);
    if place >= 0.0 {
        let step = libm::pow(10.0, place);
        let rounded = libm::round(value / step) * step;
        return if rounded.abs() < 1e7 { format!("{rounded:.0}") } else { plain(&format!("{rounded:.3e}")) };
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let decimals = (-place) as usize;
    if decimals > 7 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
        let more = (first - place) as usize;
        return plain(&format!("{value:.more$e}"));
    }
    format!("{value:.decimals$}")
}

/// So that 0.1 is one tenth and not a little less.
const LITTLE: f64 = 1e-9;

/// `1.2e-9` as people write it.
fn plain(text: &str) -> String {
    text.split_once('e').map_or_else(|| text.to_owned(), |(digits, power)| format!("{digits}·10^{power}"))
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn digits_are_those_that_a_tolerance_leaves() {
        let cases = [
            (175.309_524_5, 2.34, "175"),
            (175.309_524_5, 0.34, "175.3"),
            (5.843_650_8, 0.08, "5.84"),
            (0.000_000_000_000_019_84, 0.1, "0"),
            (-12_345.678, 120.0, "-12300"),
            (0.04, 0.9, "0.04"),
            (3.0, 0.001, "3.000"),
            (1.234_567_89e-9, 1e-11, "1.23·10^-9"),
        ];
        for (value, finest, expected) in cases {
            assert_eq!(digits(value, finest), expected, "{value} to {finest}");
        }
    }
}
