//! A report for the student who handed in: his answers as he wrote them, one sentence for each fault, marks.

use std::fmt::Write as _;

use super::answers::Form;
use super::judge::{CLOSE, Mistake, Verdict};
use super::report::{Allowed, Graded, Report};
use super::symbols::Symbols;

impl Verdict {
    /// What a student is told.
    #[must_use]
    pub fn told(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Consistent => "follows rightly from an earlier fault",
            Self::Wrong => "wrong",
            Self::NotChecked => "not determined here",
        }
    }
}

impl Graded {
    /// What was handed in, in the form and with the digits in which it was written.
    #[must_use]
    pub fn handed_in(&self) -> String {
        let written = if self.rounding > 0.0 { 2.0 * self.rounding } else { 0.0 };
        let finest = if written > 0.0 { written } else { self.tolerance / 10.0 };
        self.told(&self.given, finest, Within::Left)
    }

    /// What is right, in the same form, to three figures at least.
    #[must_use]
    pub fn expected(&self) -> String {
        self.told(&self.right, self.finest(), Within::Left)
    }

    /// The same with the tolerances: of a vector one of the magnitude and one of the direction.
    #[must_use]
    pub fn expected_within(&self) -> String {
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
    #[must_use]
    pub fn wrong_in(&self) -> Option<&'static str> {
        self.turn?;
        match (self.amiss.size, self.amiss.direction) {
            (true, true) => Some("magnitude and direction"),
            (true, false) => Some("the magnitude"),
            (false, true) => Some("the direction"),
            (false, false) => None,
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
    pub fn because(&self) -> String {
        let unit = &self.unit.symbol;
        match self.allowed {
            Allowed::Stated => "as the answers' file states it".to_owned(),
            Allowed::Calculated => "calculated from what is given, no reading is behind it".to_owned(),
            Allowed::Read { mm: Some(mm), of: Some(of) } => {
                format!("read: {} mm of {} mm on paper at that place", digits(mm, mm / 5.0), digits(of, 1.0))
            }
            Allowed::Read { .. } => "calculated from what is read off the drawing".to_owned(),
            Allowed::Capped { honest, turn } => {
                let honest = digits(honest, honest / 2.0);
                let turn = turn.map_or(String::new(), |turn| format!(" and {}°", digits(turn, turn / 2.0)));
                format!("hard to measure: a careful hand may be off by {honest} {unit}{turn} here")
            }
        }
    }

    /// Numbers in the unit in which the student wrote them: millimetres of what lies on paper.
    fn on_paper<'u>(&'u self, numbers: &[f64]) -> (Vec<f64>, &'u str) {
        match self.per_mm {
            Some(per_mm) if self.form == Form::Paper && per_mm > 0.0 => {
                (numbers.iter().map(|n| n / per_mm).collect(), "mm on paper")
            }
            _ => (numbers.to_vec(), &self.unit.symbol),
        }
    }

    /// Numbers to about a part of `finest`, with their tolerances or without.
    fn told(&self, numbers: &[f64], finest: f64, within: Within) -> String {
        let (numbers, unit) = self.on_paper(numbers);
        let (steps, _) = self.on_paper(&[finest, self.tolerance]);
        let [step, tolerance] = [0, 1].map(|place| steps.get(place).copied().unwrap_or(0.0));
        let room = |size: f64| match within {
            Within::Left => String::new(),
            Within::Told => format!(" ± {}", digits(size, size / 10.0)),
        };
        let size = room(tolerance);
        let turn = self.turn.filter(|turn| *turn < HALF_TURN).map_or(String::new(), |turn| match within {
            Within::Left => String::new(),
            Within::Told => format!(" ± {}°", digits(turn, turn / 10.0)),
        });
        let text = match numbers[..] {
            [] => return "not determined here".to_owned(),
            [value] => match (self.turns && !self.magnitude_only, value < 0.0) {
                (false, _) => format!("{}{size} {unit}", digits(value, step)),
                (true, true) => format!("{}{size} {unit} cw", digits(-value, step)),
                (true, false) => format!("{}{size} {unit} ccw", digits(value, step)),
            },
            [x, y, ..] if self.form == Form::Polar => {
                let length = digits(libm::hypot(x, y), step);
                let direction = trimmed(&digits(libm::atan2(y, x).to_degrees(), 0.1));
                format!("{length}{size} {unit} at {direction}°{turn}")
            }
            [x, y, ..] => {
                let parts = match (within, self.turn) {
                    (Within::Left, _) => String::new(),
                    (Within::Told, None) => size,
                    (Within::Told, Some(_)) if turn.is_empty() => format!(", magnitude{size} {unit}"),
                    (Within::Told, Some(_)) => format!(", magnitude{size} {unit}, direction{turn}"),
                };
                match (within, self.turn) {
                    (Within::Told, None) => {
                        format!("({}, {}){parts} {unit}", digits(x, step), digits(y, step))
                    }
                    _ => format!("({}, {}) {unit}{parts}", digits(x, step), digits(y, step)),
                }
            }
        };
        text.trim_end().to_owned()
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
    pub(super) fn notes(&self) -> Vec<String> {
        let turned = self.turned.map(|turned| {
            let sense = if turned < 0.0 { "clockwise" } else { "counter-clockwise" };
            let by = digits(turned.abs(), 0.1);
            format!("Your drawing lies turned by {by}° {sense}; it was turned back before it was compared.")
        });
        let enlarged = self.enlarged.map(|factor| {
            let (times, how) = if factor < 1.0 { (1.0 / factor, "smaller") } else { (factor, "larger") };
            let times = trimmed(&digits(times, 0.01));
            format!(
                "Your skeleton is {times} times {how} than at the sheet's scale; it was compared at its own."
            )
        });
        let stated = "The tolerance that these answers state does not count: the examiner sets it.";
        let variant = self.other_variant.as_ref().map(|variant| {
            format!(
                "These are the answers of variant {variant}: the number of the variant is wrong, or they are not the student's own. \
                 Nothing follows from them."
            )
        });
        let stated = self.tolerances_ignored.then(|| stated.to_owned());
        variant.into_iter().chain(turned).chain(enlarged).chain(stated).collect()
    }

    /// The report as text.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        if let Some(student) = &self.student {
            let _ = writeln!(text, "{student}");
        }
        for note in self.notes() {
            let _ = writeln!(text, "{note}");
        }
        let rows: Vec<[String; 3]> =
            self.quantities.iter().map(|graded| row(graded, &self.symbols)).collect();
        let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
        let widths = [width(0), width(1)];
        for (graded, [name, given, verdict]) in self.quantities.iter().zip(&rows) {
            let [a, b] = widths;
            let _ = writeln!(text, "{name:<a$}  {given:<b$}  {verdict}");
            if graded.verdict != Verdict::Wrong || self.other_variant.is_some() {
                continue;
            }
            for line in sentences(graded) {
                let _ = writeln!(text, "    {}", self.symbols.plain(&line));
            }
        }
        if !self.missing.is_empty() {
            let names: Vec<&str> = self.missing.iter().map(|(name, _)| name.as_str()).collect();
            let _ = writeln!(text, "not answered: {}", self.symbols.plain(&names.join(", ")));
        }
        for one in &self.not_read {
            let marks = if one.weight > 0.0 { ", no marks" } else { "" };
            let name = self.symbols.plain(&one.name);
            let _ = writeln!(text, "not read{marks}: {name}: {}", one.why);
        }
        if let (Some(fault), None) = (self.first_fault(), &self.other_variant) {
            let place = fault.step.map_or(String::new(), |step| format!(" in step {step}"));
            let _ = writeln!(text, "first fault{place}, {}", self.symbols.plain(&fault.text()));
        }
        let (reached, of) = self.sum();
        let _ = writeln!(text, "marks: {} of {}", marks(reached), marks(of));
        text
    }
}

/// What is said of a wrong answer: what it probably is, and where to look.
pub(super) fn sentences(graded: &Graded) -> Vec<String> {
    let Some(mistake) = graded.mistakes.first() else {
        let step = graded.step.map_or(String::new(), |step| format!(" from step {step} of the solution on"));
        return vec![format!("No known mistake leads to this value; compare your drawing{step}.")];
    };
    let told = |mistake: &Mistake| {
        let step = mistake.step.or(graded.step);
        let step = step.map_or(String::new(), |step| format!(" (step {step} of the solution)"));
        format!("{}{step}", mistake.own_text())
    };
    let parts: Vec<String> = mistake.parts().map(told).collect();
    let mut looks: Vec<&str> = mistake.parts().map(Mistake::look).collect();
    looks.dedup();
    let sum = if parts.len() > 1 { "two mistakes at once: " } else { "" };
    // What comes near by a value that is no mistake of its own is no more than possible.
    let likely = if mistake.parts().all(|part| part.residual <= CLOSE) { "Probably" } else { "Perhaps" };
    vec![format!("{likely} {sum}{}. {}", parts.join("; and "), looks.join(" "))]
}

fn row(graded: &Graded, symbols: &Symbols) -> [String; 3] {
    let verdict = match graded.verdict {
        Verdict::Right if graded.beyond => {
            format!("right as far as it can be measured ({})", graded.expected_within())
        }
        Verdict::Right => format!("right ({})", graded.expected_within()),
        Verdict::Wrong => {
            let part = graded.wrong_in().map_or(String::new(), |part| format!(" in {part}"));
            format!("wrong{part}: {} is right", graded.expected_within())
        }
        Verdict::Consistent => {
            format!("{} ({} is right)", Verdict::Consistent.told(), graded.expected())
        }
        Verdict::NotChecked => Verdict::NotChecked.told().to_owned(),
    };
    let unasked = match (graded.asked, graded.share < 1.0) {
        _ if graded.charged => ", which costs its mark here".to_owned(),
        (false, _) => ", no marks".to_owned(),
        (true, true) if graded.verdict == Verdict::Wrong && graded.reached() > 0.0 => {
            ", with marks for the part that is right".to_owned()
        }
        _ => graded.silent().map_or(String::new(), |untold| format!(", but its {untold} is not told")),
    };
    [symbols.plain(&graded.name), graded.handed_in(), verdict + &unasked]
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
