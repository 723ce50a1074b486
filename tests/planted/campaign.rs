//! Cases: a mechanism, an answer sheet with one mistake or none, and which diagnoses would be right.

use std::slice::from_ref;

use super::hand_in::{HandIn, STYLES, Style, steady};
use super::mechanism::{FAMILIES, Mechanism};
use super::mistakes::{Kind, Mistake};
use super::plane::Chance;
use super::student::{Scales, Stuck, Student, solve};

/// How many times the pencil is tried to see how far it scatters each answer.
const TRIALS: u64 = 16;
/// A planted mistake changes some answer by so many times its scatter, or it is not planted.
const CLEAR: f64 = 5.0;
/// An unforeseen fault stays so many times the scatter away from every known mistake in some answer.
const APART: f64 = 3.0;
/// v = ω times the other pin's arm: serves to recognise equal numbers, but to call it a tangential part is a stretch.
const STRETCH: &str = "to the other pin";

/// A scene and what a student hands in.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) family: &'static str,
    pub(crate) style: Style,
    pub(crate) scene: String,
    pub(crate) sheet: HandIn,
    pub(crate) planted: Vec<Mistake>,
    /// Mistakes that lead to the same numbers in everything handed in, the planted one among them.
    pub(crate) class: Vec<Mistake>,
    /// Answers that the mistake leaves as they are.
    pub(crate) unharmed: Vec<String>,
}

/// A random mechanism that goes together well clear of its dead centres.
pub(crate) fn healthy(family: &'static str, chance: &mut Chance) -> Mechanism {
    loop {
        let mechanism = Mechanism::random(family, chance);
        if steady(&mechanism, &[]).is_ok_and(|student| student.clear_of_dead_centres()) {
            return mechanism;
        }
    }
}

/// Everything that a student without fault has found, by the names of a scene's `find`.
pub(crate) fn names(student: &Student<'_>) -> Vec<String> {
    let vectors = student.readings.iter().map(|r| r.name.clone());
    vectors.chain(student.turnings.iter().map(|t| t.name.clone())).collect()
}

/// One mechanism, one mistake or none, one way of handing in.
struct Desk<'a> {
    mechanism: &'a Mechanism,
    style: Style,
}

impl Desk<'_> {
    fn sheet(&self, student: &Student<'_>, planted: &[Mistake], chance: &mut Chance) -> HandIn {
        HandIn::of(student, self.mechanism, self.style, planted, chance)
    }

    /// What is handed in when the pencil does not slip, and the scales.
    fn steady(&self, planted: &[Mistake]) -> Result<(HandIn, Scales), Stuck> {
        let student = steady(self.mechanism, planted)?;
        Ok((self.sheet(&student, planted, &mut Chance::new(0)), student.scales))
    }

    fn slipping(&self, planted: &[Mistake], scales: Scales, seed: u64) -> Result<HandIn, Stuck> {
        let student = solve(self.mechanism, planted, Some(Chance::new(seed)), scales)?;
        Ok(self.sheet(&student, planted, &mut Chance::new(seed)))
    }

    /// How far the pencil scatters each answer.
    fn scatter(&self, planted: &[Mistake], seed: u64) -> Result<(HandIn, Scales, Vec<f64>), Stuck> {
        let (sheet, scales) = self.steady(planted)?;
        let mut scatter = vec![0.0_f64; sheet.count()];
        for trial in 0..TRIALS {
            let slipped = self.slipping(planted, scales, seed ^ trial)?;
            for (most, now) in scatter.iter_mut().zip(sheet.differences(&slipped)) {
                *most = most.max(now);
            }
        }
        Ok((sheet, scales, scatter))
    }
}

/// All differences stay within so many times the scatter.
fn alike(differences: &[f64], scatter: &[f64], times: f64) -> bool {
    differences.iter().zip(scatter).all(|(d, s)| *d <= times * s)
}

/// A case with a mistake of this kind: the first that shows itself on random mechanisms.
pub(crate) fn plant(kind: Kind, seed: u64) -> Case {
    let mut chance = Chance::new(seed);
    loop {
        if let Some(case) = try_to_plant(kind, &mut chance) {
            return case;
        }
    }
}

fn try_to_plant(kind: Kind, chance: &mut Chance) -> Option<Case> {
    let family = *chance.pick(&FAMILIES);
    let mechanism = healthy(family, chance);
    let style = *chance.pick(&STYLES);
    let desk = Desk { mechanism: &mechanism, style };
    let truth = steady(&mechanism, &[]).ok()?;
    let mine: Vec<&Mistake> = truth.offered.iter().filter(|m| m.kind == kind && m.how != STRETCH).collect();
    if mine.is_empty() {
        return None;
    }
    let planted = *chance.pick(&mine);
    // Which way the guide turns cannot be told from accelerations drawn along it: what is computed from that is a guess.
    if kind == Kind::PerpendicularForParallel && planted.at.ends_with("@4)") && !mechanism.by_image {
        return None;
    }
    let seed = chance.bits();
    let (sheet, scales, scatter) = desk.scatter(from_ref(planted), seed).ok()?;
    let (right, _, calm) = desk.scatter(&[], seed).ok()?;
    let reach = if kind == Kind::Unforeseen { CLEAR + APART } else { CLEAR };
    // The scatter of the right answers stands in the order of the right sheet: compare from its side.
    let seen = !alike(&sheet.differences(&right), &scatter, reach)
        && !alike(&right.differences(&sheet), &calm, reach);
    if !seen {
        return None;
    }
    let unharmed = sheet.names_within(&right, &scatter);
    let mut class = vec![planted.clone()];
    for other in &truth.offered {
        let Ok((theirs, _)) = desk.steady(from_ref(other)) else { continue };
        if other == planted || other.kind == Kind::Unforeseen {
            continue;
        }
        let differences = sheet.differences(&theirs);
        if kind == Kind::Unforeseen {
            if alike(&differences, &scatter, APART) {
                return None;
            }
        } else if alike(&differences, &scatter, 1.0) {
            class.push(other.clone());
        }
    }
    let handed_in = desk.slipping(from_ref(planted), scales, seed ^ TRIALS).ok()?;
    let scene = mechanism.scene(&truth.places, &names(&truth));
    Some(Case { family, style, scene, sheet: handed_in, planted: vec![planted.clone()], class, unharmed })
}

/// A case with two mistakes on an examiner's sheet, where later values depend on both: neither of them alone nor any
/// other single mistake leads to the numbers.
pub(crate) fn plant_two(seed: u64) -> Case {
    let mut chance = Chance::new(seed);
    loop {
        if let Some(case) = try_to_plant_two(&mut chance) {
            return case;
        }
    }
}

fn try_to_plant_two(chance: &mut Chance) -> Option<Case> {
    let family = *chance.pick(&FAMILIES);
    let mechanism = healthy(family, chance);
    let desk = Desk { mechanism: &mechanism, style: Style::Exam };
    let truth = steady(&mechanism, &[]).ok()?;
    let one = |chance: &mut Chance| {
        let kind = *chance.pick(&Kind::FORESEEN);
        let ways = truth.offered.iter().filter(|m| m.kind == kind && m.how != STRETCH).collect::<Vec<_>>();
        (!ways.is_empty()).then(|| (*chance.pick(&ways)).clone())
    };
    let pair = [one(chance)?, one(chance)?];
    if pair[0].kind == pair[1].kind {
        return None;
    }
    let seed = chance.bits();
    let (sheet, scales, scatter) = desk.scatter(&pair, seed).ok()?;
    let told_apart = |others: &[Mistake], times| {
        desk.steady(others).is_ok_and(|(theirs, _)| !alike(&sheet.differences(&theirs), &scatter, times))
    };
    let singly = pair.iter().all(|one| told_apart(from_ref(one), CLEAR));
    let alone = truth.offered.iter().filter(|m| m.kind != Kind::Unforeseen);
    if !told_apart(&[], CLEAR) || !singly || !alone.into_iter().all(|one| told_apart(from_ref(one), APART)) {
        return None;
    }
    let sheet = desk.slipping(&pair, scales, seed ^ TRIALS).ok()?;
    let scene = mechanism.scene(&truth.places, &names(&truth));
    let class = pair.to_vec();
    Some(Case {
        family,
        style: Style::Exam,
        scene,
        sheet,
        planted: pair.to_vec(),
        class,
        unharmed: Vec::new(),
    })
}

/// A case without a mistake.
pub(crate) fn untouched(seed: u64) -> Case {
    let mut chance = Chance::new(seed);
    loop {
        let family = *chance.pick(&FAMILIES);
        let mechanism = healthy(family, &mut chance);
        let style = *chance.pick(&STYLES);
        let desk = Desk { mechanism: &mechanism, style };
        let Ok(truth) = steady(&mechanism, &[]) else { continue };
        let Ok(sheet) = desk.slipping(&[], truth.scales, chance.bits()) else { continue };
        let scene = mechanism.scene(&truth.places, &names(&truth));
        return Case {
            family,
            style,
            scene,
            sheet,
            planted: Vec::new(),
            class: Vec::new(),
            unharmed: Vec::new(),
        };
    }
}
