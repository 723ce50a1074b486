//! Every moving body is in balance by what stands printed: its forces, their moments about a point of it and the places,
//! each in the digits of the table of `solve`, and of the results of a sheet. Nothing of the solution is read besides.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write as _;
use std::process::{Command, Stdio};

use linkgram::drawing::{self, Kind, Wish};
use linkgram::mechanism::force::{Heaviness, LoadKind, Party, Sought, SpringKind};
use linkgram::mechanism::{LinkId, Mechanism, PointId, Rider, Roll};
use linkgram::scene::{self, Scene};

use crate::common;
use crate::legibility::{characters, has, number, rows_of, within};

/// A number as it is printed, with half a unit of its last figure.
#[derive(Debug, Clone, Copy)]
struct Printed {
    value: f64,
    half: f64,
}

impl Printed {
    const NONE: Self = Self { value: 0.0, half: 0.0 };

    fn times(self, other: Self) -> Self {
        let half = self.value.abs() * other.half + self.half * other.value.abs() + self.half * other.half;
        Self { value: self.value * other.value, half }
    }

    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, half: self.half + other.half }
    }

    fn less(self, other: Self) -> Self {
        self.plus(other.scaled(-1.0))
    }

    fn scaled(self, by: f64) -> Self {
        Self { value: self.value * by, half: self.half * by.abs() }
    }

    /// By its number of significant figures: noughts at the end are not printed.
    fn figures(value: f64, figures: i32) -> Self {
        if value == 0.0 {
            return Self::NONE;
        }
        let first = libm::floor(libm::log10(value.abs()) + 1e-12);
        Self { value, half: 0.5 * libm::exp10(first + 1.0 - f64::from(figures)) }
    }
}

/// What is printed of one quantity, in SI: a number, or two.
#[derive(Debug, Clone, Copy)]
enum Row {
    Scalar(Printed),
    Vector([Printed; 2]),
}

impl Row {
    /// A size and a direction in degrees.
    fn polar(size: Printed, degrees: Printed) -> Self {
        let (sin, cos) = libm::sincos(degrees.value.to_radians());
        let turn = degrees.half.to_radians();
        // How far a direction that is off by half its last figure moves the parts.
        let parts = [(cos, sin), (sin, cos)]
            .map(|(along, across)| Printed { value: along, half: turn * across.abs() + 0.5 * turn * turn });
        Self::Vector(parts.map(|part| size.times(part)))
    }
}

type Table = BTreeMap<String, Row>;

/// A force of a body as the table has it: its name, a point by which it passes, and whether its moment about that is printed
/// besides, since it need not pass through it.
struct Term {
    name: String,
    at: String,
    turns: bool,
}

/// What acts on a body, from the scene alone.
#[derive(Default)]
struct Body {
    number: u32,
    forces: Vec<Term>,
    /// Torques by their name and sense.
    torques: Vec<(String, f64)>,
    /// Springs, from the end on this body to the other one.
    springs: Vec<(String, [String; 2])>,
    /// Newtons, and where they act.
    weight: Option<([f64; 2], String)>,
}

fn bodies(m: &Mechanism) -> Option<Vec<Body>> {
    let name = |point: PointId| m.point(point).name.clone();
    let mut all = Vec::new();
    for index in 1..m.links.len() {
        let link = LinkId(index);
        let number = m.link(link).number;
        let mut body = Body { number, ..Body::default() };
        let mut push = |name: String, at: String, turns: bool| {
            body.forces.push(Term { name, at, turns });
        };
        for point in (0..m.points.len()).map(PointId) {
            let parties = m.parties_at(point);
            if parties.len() > 1 && parties.contains(&link) {
                push(format!("F({},{number})", name(point)), name(point), !m.forces.friction.is_empty());
            }
        }
        for slide in &m.slides {
            let Party::Link(rider) = m.party_of(&slide.rider) else { return None };
            let [guide, own] = [slide.guide.link, rider].map(|link| m.link(link).number);
            let at = match slide.rider {
                Rider::Pin { point, .. } => point,
                Rider::Link { .. } => *m.link(rider).points.first()?,
            };
            if rider == link {
                push(format!("F({guide},{own})"), name(at), true);
            } else if slide.guide.link == link {
                push(format!("F({own},{guide})"), name(at), true);
            }
        }
        for roll in &m.rolls {
            let [first, second] = roll.bodies();
            let other = if first == link { second } else { first };
            if first != link && second != link {
                continue;
            }
            let Roll::Circles { centres, .. } = roll else { return None };
            push(format!("F({},{number})", m.link(other).number), name(centres[0]), true);
        }
        if let Some(mass) = m.forces.mass(link) {
            if m.forces.spin.is_some() {
                push(format!("Fc({number})"), name(mass.centre), false);
            } else {
                push(format!("Fin({number})"), name(mass.centre), true);
            }
            let newtons = match mass.heaviness {
                Heaviness::Mass(kilograms) => kilograms.value * m.forces.gravity.g.value,
                Heaviness::Weight(weight) => weight.value,
                Heaviness::None => 0.0,
            };
            if m.forces.gravity.acts && newtons != 0.0 {
                let (sin, cos) = libm::sincos(m.forces.gravity.direction.value);
                body.weight = Some(([newtons * cos, newtons * sin], name(mass.centre)));
            }
        }
        for load in m.forces.loads.iter().filter(|load| load.link == link) {
            let told = format!("load({})", load.name);
            match (load.kind, load.at()) {
                (LoadKind::Torque { .. }, _) => body.torques.push((told, 1.0)),
                (_, Some(at)) => {
                    body.forces.push(Term { name: told, at: name(at), turns: false });
                }
                _ => return None,
            }
        }
        for spring in &m.forces.springs {
            let told = format!("spring({})", spring.name);
            match spring.kind {
                SpringKind::Torsion([first, second]) => {
                    body.torques.extend((second == link).then(|| (told.clone(), 1.0)));
                    body.torques.extend((first == link).then_some((told, -1.0)));
                }
                SpringKind::Pull([one, other]) => {
                    for (own, far) in [(one, other), (other, one)] {
                        if own.0 == link {
                            body.springs.push((told.clone(), [name(own.1), name(far.1)]));
                        }
                    }
                }
            }
        }
        for sought in m.sought() {
            let Sought::Effort(input) = sought else { continue };
            if m.driven_link(input)? == link {
                body.torques.push((format!("T({number})"), 1.0));
            }
        }
        all.push(body);
    }
    Some(all)
}

/// What has to be printed for it: every name once.
fn asked(bodies: &[Body]) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for body in bodies {
        for Term { name, at, turns, .. } in &body.forces {
            names.extend([name.clone(), format!("x({at})")]);
            names.extend(turns.then(|| format!("moment({name},{at})")));
        }
        names.extend(body.torques.iter().map(|(name, _)| name.clone()));
        for (name, ends) in &body.springs {
            names.insert(name.clone());
            names.extend(ends.iter().map(|end| format!("x({end})")));
        }
        names.extend(body.weight.iter().map(|(_, at)| format!("x({at})")));
    }
    names
}

/// What the table of `solve` prints, every quantity in its row; none where the program refuses the scene.
fn by_solve(text: &str, scene: &Scene) -> Option<Table> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .args(["solve", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    if !output.status.success() {
        return None;
    }
    let printed = String::from_utf8(output.stdout).unwrap();
    let mut table = Table::new();
    for asked in &scene.mechanism.asked {
        let line = printed.lines().find(|line| line.split("  ").next() == Some(&asked.name))?;
        let cells: Vec<&str> = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
        let si = asked.unit.si;
        let row = if let Some(place) = cells[1].strip_prefix('(') {
            let parts: Vec<f64> =
                place.split(')').next()?.split(", ").map(|part| part.parse().unwrap()).collect();
            // Both are printed to the last figure of the greater one.
            let half = Printed::figures(parts[0].abs().max(parts[1].abs()), 7).half;
            Row::Vector([parts[0], parts[1]].map(|value| Printed { value, half }.scaled(si)))
        } else {
            let size = Printed::figures(cells[1].split(' ').next()?.parse().ok()?, 7).scaled(si);
            match cells.get(2) {
                Some(&"cw") => Row::Scalar(size.scaled(-1.0)),
                Some(cell) if cell.ends_with(" deg") => {
                    Row::polar(size, Printed::figures(cell.trim_end_matches(" deg").parse().ok()?, 5))
                }
                _ if is_vector(&asked.name) => Row::Vector([Printed::NONE; 2]),
                _ => Row::Scalar(size),
            }
        };
        table.insert(asked.name.clone(), row);
    }
    Some(table)
}

/// Forces have two parts; a torque among the loads has a sense, and a force that is nothing neither.
fn is_vector(name: &str) -> bool {
    ["F(", "Fin(", "Fc("].iter().any(|of| name.starts_with(of))
}

/// What the results of a sheet print, every quantity in its row; none where there is no sheet.
fn by_sheet(scene: &Scene) -> Option<Table> {
    let wish = Wish { kind: Kind::Solution, figures: Vec::new(), ..Wish::default() };
    let figure = drawing::figure(scene, &wish).ok()?;
    let tables = within(&figure.root).into_iter().filter(|group| has(group, "results"));
    let rows: Vec<Vec<String>> = tables
        .flat_map(|table| rows_of(table).into_iter().skip(1))
        .map(|row| row.into_iter().map(characters).collect())
        .collect();
    if rows.is_empty() {
        // The scene itself wishes single figures.
        return None;
    }
    assert_eq!(rows.len(), scene.mechanism.asked.len());
    let mut table = Table::new();
    for (asked, row) in scene.mechanism.asked.iter().zip(rows) {
        let si = asked.unit.si;
        // Powers of ten stand behind blanks that do not break.
        let cell = row[1].as_str();
        let row = if let Some(place) = cell.strip_prefix('(') {
            let parts: Vec<Printed> = place
                .split(';')
                .map(|part| number(part).map(|(value, half, _)| Printed { value, half }.scaled(si)))
                .collect::<Option<_>>()?;
            Row::Vector([parts[0], parts[1]])
        } else {
            let (value, half, rest) = number(cell)?;
            // What is nothing has no figures.
            let size = if value == 0.0 { Printed::NONE } else { Printed { value, half }.scaled(si) };
            let told =
                format!("{rest} {}", row.get(2).map_or("", |cell| cell.as_str())).replace('\u{a0}', " ");
            let degrees = told.split(' ').find_map(|word| {
                let (value, half, rest) = number(word)?;
                rest.starts_with('°').then_some(Printed { value, half })
            });
            match degrees {
                Some(degrees) => Row::polar(size, degrees),
                None if is_vector(&asked.name) => Row::Vector([Printed::NONE; 2]),
                None if told.split(' ').any(|word| word == "cw") => Row::Scalar(size.scaled(-1.0)),
                None => Row::Scalar(size),
            }
        };
        table.insert(asked.name.clone(), row);
    }
    Some(table)
}

/// What is left of the forces and of the moments of a body beyond what half a unit of each last figure explains, and how much of
/// its largest force and moment that is.
fn unbalanced(body: &Body, m: &Mechanism, table: &Table) -> Result<[f64; 2], String> {
    let vector = |name: &str| match table.get(name) {
        Some(Row::Vector(parts)) => Ok(*parts),
        other => Err(format!("{name}: {other:?}")),
    };
    let scalar = |name: &str| match table.get(name) {
        Some(Row::Scalar(value)) => Ok(*value),
        other => Err(format!("{name}: {other:?}")),
    };
    let moment = |at: [Printed; 2], force: [Printed; 2]| at[0].times(force[1]).less(at[1].times(force[0]));
    // Of a governor one of several halves is drawn.
    let spin = m.forces.spin;
    let share = |sleeve: bool| match spin {
        Some(spin) if sleeve && spin.sleeve.is_some_and(|link| m.link(link).number == body.number) => {
            1.0 / f64::from(spin.balls)
        }
        _ => 1.0,
    };
    let (mut sum, mut turned) = ([Printed::NONE; 2], Printed::NONE);
    let (mut largest, mut most) = (0.0_f64, 0.0_f64);
    let mut add = |force: [Printed; 2], moment: Printed| {
        sum = [sum[0].plus(force[0]), sum[1].plus(force[1])];
        turned = turned.plus(moment);
        largest = largest.max(libm::hypot(force[0].value, force[1].value));
        most = most.max(moment.value.abs());
    };
    for Term { name, at, turns } in &body.forces {
        let by = share(name.starts_with("load("));
        let force = vector(name)?.map(|part| part.scaled(by));
        let own = if *turns { scalar(&format!("moment({name},{at})"))?.scaled(by) } else { Printed::NONE };
        add(force, moment(vector(&format!("x({at})"))?, force).plus(own));
    }
    for (name, sense) in &body.torques {
        add([Printed::NONE; 2], scalar(name)?.scaled(*sense));
    }
    for (name, [own, far]) in &body.springs {
        let [from, to] = [vector(&format!("x({own})"))?, vector(&format!("x({far})"))?];
        let between = [to[0].less(from[0]), to[1].less(from[1])];
        let long = libm::hypot(between[0].value, between[1].value);
        let off = between[0].half + between[1].half;
        let pull = scalar(name)?;
        let force =
            between.map(|part| pull.times(Printed { value: part.value / long, half: 2.0 * off / long }));
        add(force, moment(from, force));
    }
    if let Some((weight, at)) = &body.weight {
        let force = weight.map(|part| Printed { value: part * share(true), half: 0.0 });
        add(force, moment(vector(&format!("x({at})"))?, force));
    }
    // What is nothing is printed as such within its bound.
    const ROUNDING: f64 = 1e-9;
    for part in sum {
        if part.value.abs() > part.half + ROUNDING * largest {
            return Err(format!("{part:?} N are left of {largest}"));
        }
    }
    if turned.value.abs() > turned.half + ROUNDING * most.max(largest) {
        return Err(format!("{turned:?} N m are left of {most}"));
    }
    Ok([sum[0].half.max(sum[1].half) / largest.max(1e-9), turned.half / most.max(1e-9)])
}

/// The loaded examples, every scene of the examples and of the catalogue under loads of our own, and random chains.
fn scenes() -> Vec<(String, String)> {
    let mut all = Vec::new();
    for path in common::example_paths() {
        let text = std::fs::read_to_string(&path).unwrap();
        all.push((path.file_stem().unwrap().to_string_lossy().into_owned(), text));
    }
    let kinds = linkgram::catalogue::KINDS.iter();
    all.extend(kinds.map(|kind| (kind.name.to_owned(), kind.scene.to_owned())));
    for (_, text) in &mut all {
        let mut value: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
        let is_free = ["masses", "cycle", "loads", "spin"].iter().all(|key| value.get(key).is_none());
        if is_free && value["links"].as_object().is_some_and(|links| !links.is_empty()) {
            crate::forces_routes::loaded(&mut value, 1.0);
            *text = value.to_string();
        }
    }
    for seed in 0..40 {
        let mut chain = crate::forces::Chain::new(seed);
        (0..1 + seed % 6).for_each(|group| chain.hang(group as usize));
        all.push((format!("chain {seed}"), chain.text(&["T(2)".to_owned()])));
    }
    all
}

/// A scene that asks for what balances its bodies, and these; none where it says nothing of forces.
fn asking(name: &str, text: &str) -> Option<(String, Scene, Vec<Body>)> {
    let plain = scene::read(text, name).ok()?;
    let forces = &plain.mechanism.forces;
    if forces.masses.is_empty() && forces.loads.is_empty() && forces.springs.is_empty() {
        return None;
    }
    let bodies = bodies(&plain.mechanism)?;
    let mut value: serde_json::Value = serde_json::from_str(text).unwrap();
    let scene = value.as_object_mut()?;
    for key in ["published", "cycle", "vary", "expect"] {
        scene.remove(key);
    }
    scene.insert("find".to_owned(), asked(&bodies).into_iter().collect());
    let text = value.to_string();
    let scene = scene::read(&text, name).ok()?;
    Some((text, scene, bodies))
}

fn judge(
    (name, text): (&str, &str),
    table: impl Fn(&str, &Scene) -> Option<Table>,
    wrong: &mut Vec<String>,
) -> Option<(usize, f64)> {
    let (text, scene, bodies) = asking(name, text)?;
    let table = table(&text, &scene)?;
    let mut loosest = 0.0_f64;
    let mut judged = 0;
    for body in bodies.iter().filter(|body| !body.forces.is_empty()) {
        match unbalanced(body, &scene.mechanism, &table) {
            Ok([force, _]) => loosest = loosest.max(force),
            Err(why) => wrong.push(format!("{name}, link {}: {why}", body.number)),
        }
        judged += 1;
    }
    Some((judged, loosest))
}

/// ΣF and ΣM of every body from the printed table of `solve`.
#[test]
fn bodies_balance_by_what_solve_prints() {
    let (mut judged, mut left, mut wrong) = (0, Vec::new(), Vec::new());
    for (name, text) in scenes() {
        match judge((&name, &text), by_solve, &mut wrong) {
            Some((bodies, loosest)) => {
                judged += bodies;
                // Digits that leave more than this say nothing.
                assert!(loosest < 2e-3, "{name}: {loosest}");
            }
            None => left.push(name),
        }
    }
    println!("{judged} bodies; left out: {left:?}");
    assert!(wrong.is_empty(), "{} of {judged}: {wrong:#?}", wrong.len());
    assert!(judged > 700, "{judged}");
}

/// The same from the results of the sheets of the loaded examples.
#[test]
fn bodies_balance_by_what_a_sheet_prints() {
    let (mut judged, mut left, mut wrong) = (0, Vec::new(), Vec::new());
    for (name, text) in
        scenes().into_iter().filter(|(name, _)| name.starts_with("s000-ch5") || !name.contains('-'))
    {
        match judge((&name, &text), |_, scene| by_sheet(scene), &mut wrong) {
            Some((bodies, loosest)) => {
                judged += bodies;
                assert!(loosest < 5e-2, "{name}: {loosest}");
            }
            None => left.push(name),
        }
    }
    println!("{judged} bodies; left out: {left:?}");
    assert!(wrong.is_empty(), "{} of {judged}: {wrong:#?}", wrong.len());
    assert!(judged > 30, "{judged}");
}
