//! A force is laid off as known only if something found it before: an earlier polygon, moments of a body, the two parts of
//! it, a trial. Judged by the list of free bodies alone, which is what a sheet tells.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;
use crate::told::{CLAMP, DRIVEN_ROD};

use linkgram::graphical::construction::{
    About, Acting, Construction, ForceSheet, FreeBody, Knowledge, MomentBalance, MomentTerm, Turning,
};
use linkgram::mechanism::Mechanism;
use linkgram::mechanism::force::{Action, Force, Party, Sought};
use linkgram::mechanism::quantity::{Answer, Quantity};
use linkgram::mechanism::structure::Closing;
use linkgram::mechanism::{LinkId, PointId};
use linkgram::plan::Extent;
use linkgram::{scene, sheet, solve};

/// A force and its reaction are one.
fn pair(action: Action) -> Action {
    match action {
        Action::Pair { by, on } => Action::Pair { by: by.min(on), on: by.max(on) },
        Action::OnPin(link, pin) => Action::OfPin(pin, link),
        Action::DriveBack(input) => Action::Drive(input),
        Action::Spring { index, .. } => Action::Spring { index, end: 0 },
        Action::Rolling { roll, .. } => Action::Rolling { roll, on: LinkId::FRAME },
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
        given
            || self.has(Part::Whole(action))
            || self.has(Part::Along(action)) && self.has(Part::Across(action))
    }

    /// Whether all that moments use is found.
    fn knows_all(&self, moments: &MomentBalance) -> bool {
        moments.terms.iter().all(|term| match term.of {
            Turning::Force(action) => self.knows(action),
            Turning::Across(action) => self.has(Part::Across(pair(action))) || self.knows(action),
            Turning::Along(action) => self.has(Part::Along(pair(action))) || self.knows(action),
            Turning::Torque(Force::Moment(action, _)) => self.has(Part::Couple(pair(action))),
            Turning::Torque(_) => true,
        })
    }

    /// Whether the lines to which its arms are measured are: what a straight guide exerts on what it keeps from turning has
    /// its line beside the joint, where only the moment of it leads.
    fn sees_all(&self, moments: &MomentBalance) -> bool {
        let beside = |acting: &&Acting| {
            let [x, y] = [0, 1].map(|axis| acting.through[axis] - acting.at[axis]);
            let size = libm::hypot(acting.force[0], acting.force[1]);
            (x * acting.force[1] - y * acting.force[0]).abs() > 1e-9 * size
        };
        let all = || self.sheet.bodies.iter().flat_map(|body| &body.acting);
        moments.terms.iter().all(|term| match term.of {
            Turning::Force(action @ Action::Pair { .. }) if self.sheet.rubs.is_empty() => {
                let own = all().find(|acting| acting.action == action);
                own.filter(beside).is_none() || self.has(Part::Couple(pair(action)))
            }
            _ => true,
        })
    }

    fn learn(&mut self, part: Part) -> bool {
        let new = !self.has(part);
        self.found.extend(new.then_some(part));
        new
    }

    fn learn_moments(&mut self, told: usize) -> bool {
        let mut more = false;
        for moments in self.sheet.moments.iter().filter(|moments| moments.told == told) {
            if !self.knows_all(moments) || !self.sees_all(moments) {
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
                            Party::Link(rider) => Action::Pair { by: guide, on: rider },
                            Party::Pin(pin) => match mechanism.parties_at(pin)[..] {
                                [one, other] => Action::Pair { by: one, on: other },
                                _ => Action::OnPin(guide, pin),
                            },
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
        for moments in sheet.moments.iter().filter(|moments| chunk.contains(&moments.told)) {
            if !reader.knows_all(moments) {
                wrong.push(format!("moments of {:?} use what nothing found", moments.links));
            } else if !reader.sees_all(moments) {
                wrong
                    .push(format!("moments of {:?} have an arm to a line that nothing found", moments.links));
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
        // A torque on the last link alone: what slides passes on a couple.
        let mut value: serde_json::Value = serde_json::from_str(kind.scene).unwrap();
        if ["masses", "cycle", "loads", "spin"].iter().all(|key| value.get(key).is_none()) {
            let links = value["links"].as_object().unwrap().keys();
            let last = links.filter_map(|number| number.parse::<u64>().ok()).max().unwrap();
            value["loads"] = serde_json::json!([{ "name": "N", "on": last, "torque": "3 N*m" }]);
            value.as_object_mut().unwrap().remove("find");
            all.push((format!("{} under a torque", kind.name), value.to_string()));
        }
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

/// What the other solver says of forces: sizes, and moments about one fixed point.
struct Truth<'a> {
    state: &'a linkgram::analytic::State,
    sheet: &'a ForceSheet,
    about: PointId,
    /// That point, metres from the skeleton's origin.
    at: [f64; 2],
}

impl Truth<'_> {
    fn scalar(&self, force: Force) -> Option<f64> {
        match self.state.answer(&Quantity::Force(force, self.sheet.share)) {
            Answer::Scalar { value, .. } => Some(value),
            _ => None,
        }
    }

    fn vector(&self, action: Action) -> Option<[f64; 2]> {
        match self.state.answer(&Quantity::Force(Force::Vector(action), self.sheet.share)) {
            Answer::Vector { value, .. } => Some(value),
            _ => None,
        }
    }

    /// The moment of a force about a place; that of inertia with its couple.
    fn moment(&self, action: Action, place: [f64; 2]) -> Option<f64> {
        let [x, y] = self.vector(action)?;
        let own = self.scalar(Force::Moment(action, self.about))?;
        Some(own + (self.at[0] - place[0]) * y - (self.at[1] - place[1]) * x)
    }

    /// What acts on a body comes to nothing: its forces, and their moments with those of its torques.
    fn unbalanced(&self, body: &FreeBody) -> Option<String> {
        let (mut sum, mut turned, mut largest, mut most) = ([0.0; 2], 0.0, 0.0_f64, 0.0_f64);
        for acting in &body.acting {
            let of_pair = matches!(
                acting.action,
                Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..) | Action::Rolling { .. }
            );
            // What is given is taken as it stands.
            let ([x, y], moment) = match of_pair {
                true => (self.vector(acting.action)?, self.moment(acting.action, self.at)?),
                false => {
                    let [dx, dy] = [0, 1].map(|axis| acting.through[axis] - self.at[axis]);
                    (acting.force, dx * acting.force[1] - dy * acting.force[0])
                }
            };
            let size = libm::hypot(x, y);
            // The body has what the solver has, by a line or as a couple.
            let [fx, fy] = acting.force;
            let [dx, dy] = [0, 1].map(|axis| acting.through[axis] - self.at[axis]);
            let drawn = dx * fy - dy * fx + acting.couple;
            let reach = libm::hypot(dx, dy) * libm::hypot(fx, fy);
            let scale = moment.abs().max(reach).max(acting.couple.abs());
            let tolerance = if self.sheet.rubs.is_empty() { 1e-6 } else { 1e-4 };
            if (drawn - moment).abs() > tolerance * scale.max(1e-6) && size > 1e-9 {
                return Some(format!("{:?}: {drawn} for a moment {moment}", acting.action));
            }
            if size <= 1e-9 && (drawn - moment).abs() > 1e-6 * scale.max(1e-6) {
                return Some(format!(
                    "{:?} passes on no force: {drawn} for a couple {moment}",
                    acting.action
                ));
            }
            (largest, most) = (largest.max(size), most.max(moment.abs()));
            sum = [sum[0] + x, sum[1] + y];
            turned += moment;
        }
        for (_, value) in &body.torques {
            most = most.max(value.abs());
            turned += value;
        }
        let tolerance = if self.sheet.rubs.is_empty() { 1e-6 } else { 1e-4 };
        let left = libm::hypot(sum[0], sum[1]);
        (left > tolerance * largest.max(1e-6) || turned.abs() > tolerance * most.max(1e-6))
            .then(|| format!("{left} N of {largest} and {turned} N m of {most} are left"))
    }

    /// What a term of moments is, where it is that of a force of a pair.
    fn of_term(
        &self,
        term: &MomentTerm,
        moments: &MomentBalance,
        construction: &Construction,
    ) -> Option<f64> {
        let per_mm = construction.space.metres_per_mm;
        let stands = |point: PointId| construction.space.places[point.0].map(|at| at.map(|mm| mm * per_mm));
        let place = match moments.about {
            About::Point(point) => stands(point)?,
            About::Meet { at, .. } | About::Contact { at, .. } | About::Centre { at, .. } => at,
        };
        let Turning::Force(action) = term.of else { return None };
        let of_pair = matches!(action, Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..));
        if !of_pair {
            return None;
        }
        // What is carried to a pin turns as it does there.
        if let Some((link, pin)) = moments.carried {
            let (_, links) = action.about();
            if links.contains(&Some(link)) {
                let (at, [x, y]) = (stands(pin)?, self.vector(action)?);
                return Some((at[0] - place[0]) * y - (at[1] - place[1]) * x);
            }
        }
        // The couple beside it is a term of its own: it is taken through the joint, or where the pin there touches its circle.
        let touches = self.sheet.moments.iter().find_map(|other| match (other.found.of, other.about) {
            (Turning::Torque(Force::Moment(of, _)), About::Contact { at, .. })
                if pair(of) == pair(action) =>
            {
                Some(at)
            }
            _ => None,
        });
        let beside = moments.terms.iter().find_map(|other| match other.of {
            Turning::Torque(Force::Moment(of, about)) if pair(of) == pair(action) => Some(about),
            _ => None,
        });
        if let Some(joint) = beside {
            let (at, [x, y]) = (touches.or(stands(joint))?, self.vector(action)?);
            return Some((at[0] - place[0]) * y - (at[1] - place[1]) * x);
        }
        self.moment(action, place)
    }
}

/// Every free body is in balance by what the other solver finds, with the couples of pairs that pass on no force; and every
/// line of moments is that of forces as this solver has them, and closes.
#[test]
fn free_bodies_and_their_moments_balance_by_the_other_solver() {
    let (mut bodies, mut terms, mut couples, mut wrong) = (0, 0, 0, Vec::new());
    for (name, text) in scenes() {
        let Ok(scene) = scene::read(&text, &name) else { continue };
        let Ok(solved) = solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene) else {
            continue;
        };
        let construction = &solved.solution.construction;
        let Some(sheet) = &construction.forces else { continue };
        let m = &scene.mechanism;
        if sheet.governor.is_some() || m.forces.spin.is_some() || m.forces.cycle.is_some() {
            continue;
        }
        let fixed = (0..m.points.len()).map(PointId).filter(|point| m.is_fixed(*point));
        let per_mm = construction.space.metres_per_mm;
        let place = |point: PointId| construction.space.places[point.0].map(|at| at.map(|mm| mm * per_mm));
        let Some((about, at)) = fixed.into_iter().find_map(|point| Some((point, place(point)?))) else {
            continue;
        };
        let mut asked = Vec::new();
        for acting in sheet.bodies.iter().flat_map(|body| &body.acting) {
            asked.extend([Force::Vector(acting.action), Force::Moment(acting.action, about)]);
        }
        let used = sheet.moments.iter().flat_map(|moments| &moments.terms);
        for term in used {
            if let Turning::Force(action) = term.of {
                asked.extend([Force::Vector(action), Force::Moment(action, about)]);
            }
        }
        let asked: Vec<Quantity> = asked.into_iter().map(|of| Quantity::Force(of, sheet.share)).collect();
        let Ok(state) = solve::solve_analytically_for(&scene, &asked) else { continue };
        let truth = Truth { state: &state, sheet, about, at };
        for body in sheet.bodies.iter().filter(|body| matches!(body.of, Party::Link(_))) {
            bodies += 1;
            couples += body.acting.iter().filter(|acting| acting.couple != 0.0).count();
            wrong.extend(truth.unbalanced(body).map(|why| format!("{name}: {:?}: {why}", body.of)));
        }
        let tolerance = if sheet.rubs.is_empty() { 1e-6 } else { 1e-4 };
        for moments in &sheet.moments {
            let all = || moments.terms.iter().chain([&moments.found]);
            let largest = all().map(|term| term.moment.abs()).fold(1e-9, f64::max);
            let left: f64 = all().map(|term| term.moment).sum();
            // An arm that is shorter on paper than can be measured is none.
            let of_links = |body: &&FreeBody| body.links().iter().all(|link| moments.links.contains(link));
            let forces = sheet.bodies.iter().filter(of_links).flat_map(|body| &body.acting);
            let forces: f64 = forces.map(|acting| libm::hypot(acting.force[0], acting.force[1])).sum();
            let unmeasured = 0.02 * per_mm * forces;
            if left.abs() > tolerance * largest + unmeasured {
                wrong.push(format!("{name}: moments of {:?} leave {left} of {largest}", moments.links));
            }
            for term in all() {
                let Some(own) = truth.of_term(term, moments, construction) else { continue };
                terms += 1;
                if (own - term.moment).abs() > tolerance * largest + unmeasured {
                    let told = (term.of, term.moment);
                    wrong.push(format!("{name}: moments of {:?}: {told:?} is {own}", moments.links));
                }
            }
        }
    }
    println!("{bodies} bodies, {terms} terms, {couples} couples");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(bodies > 800 && terms > 600 && couples > 8, "{bodies} {terms} {couples}");
}
