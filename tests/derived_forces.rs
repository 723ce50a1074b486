//! A force is laid off as known only if something found it before: an earlier polygon, moments of a body, the two parts of
//! it, a trial. Judged by the list of free bodies alone, which is what a sheet tells.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;
use crate::told::{CLAMP, DRIVEN_ROD};

use linkgram::graphical::construction::{Acting, ForceSheet, FreeBody, Knowledge, Turning};
use linkgram::mechanism::Mechanism;
use linkgram::mechanism::force::{Action, Force, Sought};
use linkgram::mechanism::structure::Closing;
use linkgram::plan::Extent;
use linkgram::{scene, sheet, solve};

/// A force and its reaction are one.
fn pair(action: Action) -> Action {
    match action {
        Action::Pair { by, on } => Action::Pair { by: by.min(on), on: by.max(on) },
        Action::OnPin(link, pin) => Action::OfPin(pin, link),
        Action::DriveBack(input) => Action::Drive(input),
        Action::Spring { index, .. } => Action::Spring { index, end: 0 },
        Action::Rolling { roll, .. } => Action::Rolling { roll, on: linkgram::mechanism::LinkId::FRAME },
        other => other,
    }
}

/// What of a force is found.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    Whole(Action),
    Along(Action),
    Across(Action),
    /// A couple of it.
    Couple(Action),
}

struct Reader<'a> {
    mechanism: &'a Mechanism,
    sheet: &'a ForceSheet,
    found: Vec<Part>,
}

impl Reader<'_> {
    fn has(&self, part: Part) -> bool {
        self.found.contains(&part)
    }

    fn knows(&self, action: Action) -> bool {
        let m = self.mechanism;
        let given = match action {
            Action::Load(index) => !m.forces.loads[index].is_sought(),
            Action::Spring { index, .. } => !m.forces.springs[index].is_sought(),
            Action::Weight(_) | Action::Inertia(_) | Action::Drag(_) | Action::Centrifugal(_) => true,
            _ => false,
        };
        let action = pair(action);
        let whole = |action: Action| {
            self.has(Part::Whole(action)) || self.has(Part::Along(action)) && self.has(Part::Across(action))
        };
        // A pin hands on to one link what all others exert on it.
        let others = match action {
            Action::OfPin(pin, on) if m.drive_of_pin(pin).is_none() => {
                let others = m.parties_at(pin).into_iter().filter(|link| *link != on);
                let all: Vec<bool> = others.map(|link| whole(Action::OfPin(pin, link))).collect();
                all.iter().all(|known| *known)
            }
            _ => false,
        };
        given || whole(action) || others
    }

    fn learn(&mut self, part: Part) -> bool {
        let new = !self.has(part);
        self.found.extend(new.then_some(part));
        new
    }

    fn learn_moments(&mut self, told: usize) -> bool {
        let mut more = false;
        for moments in self.sheet.moments.iter().filter(|moments| moments.told == told) {
            let known = moments.terms.iter().all(|term| match term.of {
                Turning::Force(action) => self.knows(action),
                Turning::Across(action) => self.has(Part::Across(pair(action))) || self.knows(action),
                Turning::Along(action) => self.has(Part::Along(pair(action))) || self.knows(action),
                Turning::Torque(Force::Moment(action, _)) => self.has(Part::Couple(pair(action))),
                Turning::Torque(_) => true,
            });
            if !known {
                continue;
            }
            more |= match moments.found.of {
                Turning::Force(action) => self.learn(Part::Whole(pair(action))),
                Turning::Across(action) => self.learn(Part::Across(pair(action))),
                Turning::Along(action) => self.learn(Part::Along(pair(action))),
                Turning::Torque(Force::Moment(action, _)) => self.learn(Part::Couple(pair(action))),
                Turning::Torque(_) => false,
            };
        }
        more
    }

    /// How many sizes of a force are open.
    fn open(&self, acting: &Acting) -> usize {
        if self.knows(acting.action) {
            return 0;
        }
        let in_part = [Part::Across(pair(acting.action)), Part::Along(pair(acting.action))]
            .iter()
            .any(|part| self.has(*part));
        match acting.known {
            _ if in_part => 1,
            Knowledge::Nothing => 2,
            Knowledge::Line | Knowledge::Full => 1,
        }
    }

    /// Takes up what a polygon gives; `false` where it is not told, or was taken up.
    fn learn_polygon(&mut self, body: &FreeBody) -> bool {
        let sized = |acting: &&Acting| acting.force != [0.0; 2];
        let acting: Vec<&Acting> = body.acting.iter().filter(sized).collect();
        let known = |acting: &&&Acting| !acting.closes && self.open(acting) > 0;
        if acting.iter().filter(known).count() > 0 {
            return false;
        }
        let open: usize = acting.iter().map(|acting| self.open(acting)).sum();
        if open > 2 || acting.len() < 2 {
            return false;
        }
        let mut more = false;
        for acting in acting {
            more |= self.learn(Part::Whole(pair(acting.action)));
        }
        more
    }
}

/// What a sheet lays off, or reads off a polygon, that nothing has found.
fn unfounded(mechanism: &Mechanism, sheet: &ForceSheet) -> Vec<String> {
    let mut reader = Reader { mechanism, sheet, found: Vec::new() };
    let sought = sheet.trial.iter().map(|trial| trial.sought);
    let sought = sought.chain(sheet.trials.iter().flat_map(|trials| trials.sought.iter().map(|(of, _)| *of)));
    for sought in sought {
        match sought {
            Sought::Load(index) => _ = reader.learn(Part::Whole(Action::Load(index))),
            Sought::Spring(index) => _ = reader.learn(Part::Whole(Action::Spring { index, end: 0 })),
            _ => {}
        }
    }
    // What is zero is nothing that is laid off.
    for acting in sheet.bodies.iter().flat_map(|body| &body.acting).filter(|acting| acting.force == [0.0; 2])
    {
        reader.learn(Part::Whole(pair(acting.action)));
    }
    let mut wrong = Vec::new();
    let mut first = 0;
    while first < sheet.bodies.len() {
        let together = sheet.bodies[first..].iter().take_while(|body| body.with_next).count();
        let chunk = first..(first + together + 1).min(sheet.bodies.len());
        for trial in sheet.group_trials.iter().filter(|trial| chunk.contains(&trial.told)) {
            for (_, closing, _) in &trial.found {
                match *closing {
                    Closing::Rod { link, near, .. } => {
                        let parties = mechanism.parties_at(near);
                        let action = match parties[..] {
                            [one, other] => {
                                Action::Pair { by: if one == link { other } else { one }, on: link }
                            }
                            _ => Action::OfPin(near, link),
                        };
                        reader.learn(Part::Along(pair(action)));
                    }
                    Closing::Slide { slide, .. } => {
                        let slide = mechanism.slides[slide];
                        let guide = slide.guide.link;
                        let action = match mechanism.party_of(&slide.rider) {
                            linkgram::mechanism::force::Party::Link(rider) => {
                                Action::Pair { by: guide, on: rider }
                            }
                            linkgram::mechanism::force::Party::Pin(pin) => {
                                match mechanism.parties_at(pin)[..] {
                                    [one, other] => Action::Pair { by: one, on: other },
                                    _ => Action::OnPin(guide, pin),
                                }
                            }
                        };
                        reader.learn(Part::Whole(pair(action)));
                    }
                    Closing::Driven { input, .. } => _ = reader.learn(Part::Whole(Action::Drive(input))),
                    Closing::Contact { roll, .. } | Closing::Roll { roll } => {
                        let [_, on] = mechanism.rolls[roll].bodies();
                        reader.learn(Part::Whole(pair(mechanism.force_of_roll(roll, on))));
                    }
                    Closing::Angle { .. } => {}
                }
            }
        }
        loop {
            let mut more = false;
            for index in chunk.clone() {
                more |= reader.learn_moments(index);
                more |= reader.learn_polygon(&sheet.bodies[index]);
            }
            if !more {
                break;
            }
        }
        for body in &sheet.bodies[chunk.clone()] {
            let all = &body.acting;
            // Two forces that nobody knows yet give only their line.
            let line_only = all.len() == 2 && all.iter().all(|acting| acting.closes);
            for acting in all.iter().filter(|acting| acting.force != [0.0; 2]) {
                if !line_only && !reader.knows(acting.action) {
                    let how = if acting.closes { "closes" } else { "is laid off" };
                    wrong.push(format!("on {:?} {:?} {how}", body.of, acting.action));
                }
            }
        }
        first = chunk.end;
    }
    wrong
}

/// Random chains under load.
const CHAINS: u64 = 100;

/// Everything with forces that the project has, the catalogue and random chains under load.
fn scenes() -> Vec<(String, String)> {
    let folders = ["examples/forces", "examples", "examples/exam", "tests/derived"]
        .map(|name| common::root().join(name));
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let files = files.map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    let mut all: Vec<(String, String)> =
        files.map(|path| (path.display().to_string(), std::fs::read_to_string(&path).unwrap())).collect();
    let own = [("driven rod", DRIVEN_ROD), ("clamp", CLAMP)];
    all.extend(own.map(|(name, text)| (name.to_owned(), text.to_owned())));
    for kind in linkgram::catalogue::KINDS {
        let mut value: serde_json::Value = serde_json::from_str(kind.scene).unwrap();
        if ["masses", "cycle"].iter().all(|key| value.get(key).is_none()) {
            crate::forces_routes::loaded(&mut value, 1.0);
        }
        all.push((kind.name.to_owned(), value.to_string()));
    }
    for seed in 0..CHAINS {
        let mut chain = crate::forces::Chain::new(seed);
        (0..3).for_each(|group| chain.hang(group));
        all.push((format!("chain {seed}"), chain.text(&["T(2)".to_owned()])));
    }
    all
}

#[test]
fn no_force_is_laid_off_before_something_found_it() {
    let (mut judged, mut wrong) = (0, Vec::new());
    for (name, text) in scenes() {
        let Ok(scene) = scene::read(&text, &name) else { continue };
        let Ok(solved) = solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene) else {
            continue;
        };
        let Some(sheet) = &solved.solution.construction.forces else { continue };
        if sheet.governor.is_some() {
            continue;
        }
        judged += sheet.bodies.len();
        let own = unfounded(&scene.mechanism, sheet);
        wrong.extend(own.into_iter().map(|why| format!("{name}: {why}")));
    }
    println!("{judged} bodies");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(judged > 900, "{judged}");
}
