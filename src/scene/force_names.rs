//! Names of forces: `F(2,3)`, `T(2)`, `moment(FS,O2)`.

use super::asked::head_of;
use super::diagnostic::{Fault, Res, list};
use super::draft::Draft;
use super::forces::{effort_of_link, effort_of_slide};
use crate::mechanism::force::{Action, Force, Inertia, Share, Sought, SpringKind};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::{LinkId, PointId, Rider};

/// The names of forces that a scene may ask for.
pub(super) const FORCES: [(&str, &str); 20] = [
    ("F(2,3)", "force of link 2 on link 3 through their pair"),
    ("F(B,4)", "force of pin B on link 4, for pins of several links"),
    ("F(4,B)", "force of link 4 on pin B"),
    ("F(frame)", "all that moving links exert on the frame through pairs"),
    ("Fn(3,4/O4)", "part of F(3,4) along the line from O4 to the pin of links 3 and 4"),
    ("Ft(3,4/O4)", "part of F(3,4) across that line"),
    ("T(2)", "torque of the surroundings on the driven link 2 that balances everything"),
    ("drive(D)", "force along the guide at the driven slide D"),
    ("load(P)", "the load named P, given or sought"),
    ("spring(S)", "the pull of the spring named S"),
    ("Fin(3)", "inertia force of link 3, mass times acceleration of G, reversed"),
    ("Tin(3)", "inertia torque of link 3"),
    ("h(3)", "distance of the inertia force of link 3 from its mass centre"),
    ("FS", "shaking force, the sum of all inertia forces"),
    ("moment(F(1,6),D)", "moment of a force about a point, with its couple"),
    ("arm(FS,O2)", "distance of the line of a force from a point"),
    ("Fc(3)", "force M ω² r of link 3 away from the axis of a governor"),
    ("spin", "speed at which a governor is in equilibrium"),
    ("spin(rising)", "the same with the sleeve about to move along its guide"),
    ("spin(falling)", "the same with the sleeve about to move back"),
];

/// Reads the name of a force; `None` where it is none.
pub(super) fn parse(name: &str, at: usize, draft: &Draft<'_>) -> Res<Option<Quantity>> {
    let (bare, share) = match name.trim() {
        n if n.ends_with(".static") => (&n[..n.len() - ".static".len()], Share::Static),
        n if n.ends_with(".inertia") => (&n[..n.len() - ".inertia".len()], Share::Inertia),
        n => (n, Share::Total),
    };
    let head = bare.split('(').next().unwrap_or_default().trim();
    if !FORCES.iter().any(|(form, _)| head_of(form) == head) || (head != bare && !bare.ends_with(')')) {
        return Ok(None);
    }
    let name = ForceName { whole: name, at, draft };
    if draft.mechanism.forces.is_empty() {
        return Err(name
            .fault("the scene says nothing of forces")
            .mend("give `loads`, `masses` or `springs` (`linkgram help forces`)"));
    }
    if share != Share::Total && !draft.mechanism.forces.friction.is_empty() {
        return Err(name
            .fault("with friction the parts of a force do not add up to it")
            .mend(format!("ask for {bare}")));
    }
    if head == "spin" {
        return name.spin(bare).map(|share| Some(Quantity::Force(Force::Spin, share)));
    }
    let force = name.force(bare)?;
    if share != Share::Total && !draft.mechanism.forces.pressures.is_empty() && hangs_on_pairs(force) {
        return Err(name
            .fault("teeth push their wheels apart whichever way they drive: the parts do not add up to the force")
            .mend(format!("ask for {bare}, or give the pair \"pressure\": 0")));
    }
    Ok(Some(Quantity::Force(force, share)))
}

/// Whether it is a force that pairs exert.
fn hangs_on_pairs(force: Force) -> bool {
    match force {
        Force::Along { .. } | Force::Across { .. } => true,
        Force::Vector(action) | Force::Moment(action, _) | Force::Arm(action, _) => {
            matches!(action, Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..) | Action::OnFrame)
        }
        _ => false,
    }
}

/// The efforts and every force of a pair: what a scene with forces asks where it has no `find`.
pub(super) fn everything(draft: &Draft<'_>) -> Vec<Force> {
    let mechanism = &draft.mechanism;
    let mut asked: Vec<Force> =
        mechanism.sought().into_iter().map(|sought| of_sought(sought, draft)).collect();
    let links = (0..mechanism.links.len()).map(LinkId);
    let mut ask = |action: Action| {
        if !asked.contains(&Force::Vector(action)) {
            asked.push(Force::Vector(action));
        }
    };
    for by in links.clone() {
        for on in links.clone().filter(|on| *on > by) {
            for pair in mechanism.pairs_between(by, on) {
                use crate::mechanism::force::Through;
                match pair {
                    Through::Pin(pin) if mechanism.parties_at(pin).len() > 2 => {
                        for link in mechanism.parties_at(pin) {
                            if mechanism.carrier(pin) != Some(link) {
                                ask(Action::OfPin(pin, link));
                            }
                        }
                    }
                    _ => ask(Action::Pair { by, on }),
                }
            }
        }
    }
    asked
}

fn of_sought(sought: Sought, draft: &Draft<'_>) -> Force {
    let forces = &draft.mechanism.forces;
    match sought {
        Sought::Effort(input) if draft.mechanism.driven_link(input).is_some() => Force::Torque(input),
        Sought::Effort(input) => Force::Drive(input),
        Sought::Load(index) if forces.loads[index].is_torque() => Force::LoadTorque(index),
        Sought::Load(index) => Force::Vector(Action::Load(index)),
        Sought::Spring(index) => match forces.springs[index].kind {
            SpringKind::Pull(_) => Force::Pull(index),
            SpringKind::Torsion(_) => Force::Twist(index),
        },
        Sought::Spin => Force::Spin,
    }
}

struct ForceName<'n, 'd, 's> {
    whole: &'n str,
    at: usize,
    draft: &'d Draft<'s>,
}

/// What stands in the parentheses of a name.
enum Token {
    Link(LinkId),
    Point(PointId),
}

impl ForceName<'_, '_, '_> {
    fn fault(&self, what: impl AsRef<str>) -> Fault {
        Fault::new(self.at, format!("`{}`: {}", self.whole, what.as_ref()))
    }

    fn inside<'t>(&self, text: &'t str) -> Res<(&'t str, &'t str)> {
        let (head, rest) = text.split_once('(').ok_or_else(|| {
            let form = FORCES.iter().find(|(form, _)| head_of(form) == text).map_or("", |(form, _)| form);
            self.fault("what it is of is missing").mend(format!("write {form}"))
        })?;
        let inside = rest.strip_suffix(')').ok_or_else(|| self.fault("a parenthesis is not closed"))?;
        Ok((head.trim(), inside.trim()))
    }

    fn token(&self, text: &str) -> Res<Token> {
        let text = text.trim();
        match text.parse::<u32>() {
            Ok(number) => {
                let known: Vec<String> =
                    self.draft.mechanism.links.iter().map(|l| l.number.to_string()).collect();
                let found = self.draft.link_of(number, self.at);
                found.map(Token::Link).map_err(|_| {
                    self.fault(format!("there is no link {number}"))
                        .known(text, known.iter().map(String::as_str))
                })
            }
            Err(_) => Ok(Token::Point(self.point(text)?)),
        }
    }

    fn point(&self, text: &str) -> Res<PointId> {
        let text = text.trim();
        self.draft.point_named(text, self.at).map_err(|_| {
            let names = self.draft.mechanism.points.iter().map(|p| p.name.as_str());
            self.fault(format!("there is no point `{text}`")).known(text, names)
        })
    }

    fn link(&self, text: &str) -> Res<LinkId> {
        match self.token(text)? {
            Token::Link(link) => Ok(link),
            Token::Point(_) => Err(self.fault("the number of a link is expected here")),
        }
    }

    fn massive(&self, text: &str) -> Res<LinkId> {
        let link = self.link(text)?;
        if link == LinkId::FRAME {
            let what = "link 1 is the frame and has no mass";
            return Err(self.fault(what).mend("ask for that of a moving link"));
        }
        if self.draft.mechanism.forces.mass(link).is_none() {
            return Err(self.fault(format!("{} has no mass", self.draft.say(link))).mend(format!(
                "give it one in `masses`: \"{}\": {{\"mass\": …}}",
                self.draft.link(link).number
            )));
        }
        Ok(link)
    }

    fn force(&self, text: &str) -> Res<Force> {
        let head = text.split('(').next().unwrap_or_default().trim();
        match head {
            "F" | "FS" | "Fin" | "Fc" | "load" => self.action_or_scalar(text),
            "Fn" | "Ft" => {
                let (head, inside) = self.inside(text)?;
                let (pair, from) = inside.split_once('/').ok_or_else(|| {
                    self.fault("the point is missing").mend(format!("write {head}(3,4/O4)"))
                })?;
                let (by, on) = self.pair(pair)?;
                let from = self.point(from)?;
                let Some(pin) = self.draft.mechanism.meeting_point(by, on) else {
                    return Err(self.fault("the two links have no pin from which a line would run"));
                };
                if pin == from {
                    return Err(self.fault("the point is the pin itself: no line runs from it to the pin"));
                }
                Ok(if head == "Fn" { Force::Along { by, on, from } } else { Force::Across { by, on, from } })
            }
            "T" => {
                let (_, inside) = self.inside(text)?;
                let link = self.link(inside)?;
                let Some(input) = effort_of_link(link, self.draft) else {
                    let driven = (0..self.draft.mechanism.inputs.len())
                        .filter_map(|input| self.draft.mechanism.driven_link(input))
                        .map(|link| format!("T({})", self.draft.link(link).number))
                        .collect::<Vec<_>>();
                    let fault = self.fault(format!("{} is not driven by its angle", self.draft.say(link)));
                    return Err(if driven.is_empty() { fault } else { fault.mend(driven.join(", ")) });
                };
                self.is_sought()?;
                Ok(Force::Torque(input))
            }
            "drive" => {
                let (_, inside) = self.inside(text)?;
                let token = self.token(inside)?;
                let slides = self.draft.mechanism.slides.iter();
                let named = slides.enumerate().filter(|(_, slide)| match (&token, slide.rider) {
                    (Token::Point(pin), Rider::Pin { point, .. }) => *pin == point,
                    (Token::Link(link), Rider::Link { link: rider, .. }) => *link == rider,
                    (Token::Link(link), Rider::Pin { block, .. }) => Some(*link) == block,
                    (Token::Point(pin), Rider::Link { .. }) => {
                        self.draft.riding_point(&slide.rider) == Some(*pin)
                    }
                });
                let input = named.filter_map(|(index, _)| effort_of_slide(index, self.draft)).next();
                let input = input.ok_or_else(|| self.fault("no input drives a slide of this name"))?;
                self.is_sought()?;
                Ok(Force::Drive(input))
            }
            "spring" => {
                let (_, inside) = self.inside(text)?;
                let springs = &self.draft.mechanism.forces.springs;
                let index = springs.iter().position(|spring| spring.name == inside).ok_or_else(|| {
                    self.fault(format!("there is no spring `{inside}`"))
                        .known(inside, springs.iter().map(|s| s.name.as_str()))
                })?;
                Ok(match springs[index].kind {
                    SpringKind::Pull(_) => Force::Pull(index),
                    SpringKind::Torsion(_) => Force::Twist(index),
                })
            }
            "Tin" => {
                let (_, inside) = self.inside(text)?;
                Ok(Force::InertiaTorque(self.turning(inside)?))
            }
            "h" => {
                let (_, inside) = self.inside(text)?;
                Ok(Force::Offset(self.turning(inside)?))
            }
            "moment" | "arm" => {
                let (head, inside) = self.inside(text)?;
                let (force, about) = inside
                    .rsplit_once(',')
                    .ok_or_else(|| self.fault("the point is missing").mend(format!("write {head}(FS,O2)")))?;
                if let Some((of, part)) = force.trim().rsplit_once('.')
                    && matches!(part, "static" | "inertia")
                {
                    return Err(self
                        .fault("the part stands after the whole name")
                        .mend(format!("write {head}({of},{}).{part}", about.trim())));
                }
                let about = self.point(about)?;
                let Force::Vector(action) = self.action_or_scalar(force.trim())? else {
                    return Err(self.fault("only a force has a line, a torque has none"));
                };
                Ok(if head == "moment" { Force::Moment(action, about) } else { Force::Arm(action, about) })
            }
            _ => Err(self.fault("this is not the name of a force")),
        }
    }

    /// In which sense a governor is about to move, of a speed that is asked.
    fn spin(&self, text: &str) -> Res<Share> {
        let forces = &self.draft.mechanism.forces;
        let Some(spin) = forces.spin.filter(|spin| spin.omega == SpinSpeed::Sought) else {
            return Err(self.fault("no speed is sought").mend("give `spin` with \"omega\": \"?\""));
        };
        let share = match text.split_once('(').map(|(_, rest)| rest.trim_end_matches(')').trim()) {
            None => return Ok(Share::Total),
            Some("rising") => Share::Rising,
            Some("falling") => Share::Falling,
            Some(_) => {
                return Err(self
                    .fault("a sleeve is `rising` or `falling`")
                    .mend("spin(rising), spin(falling)"));
            }
        };
        if spin.sleeve.is_none() {
            return Err(self.fault("no sleeve is named").mend("name it in `spin`: \"sleeve\": 4"));
        }
        Ok(share)
    }

    /// A link that has a moment of inertia.
    fn turning(&self, text: &str) -> Res<LinkId> {
        let link = self.massive(text)?;
        match self.draft.mechanism.forces.mass(link).map(|mass| mass.inertia) {
            Some(Inertia::Point) | None => Err(self
                .fault(format!("{} has no moment of inertia", self.draft.say(link)))
                .mend("give `inertia` or `gyration` in `masses`")),
            Some(_) => Ok(link),
        }
    }

    /// The inputs have efforts of their own.
    fn is_sought(&self) -> Res<()> {
        let forces = &self.draft.mechanism.forces;
        let names: Vec<&str> = self
            .draft
            .mechanism
            .named_sought()
            .into_iter()
            .map(|sought| match sought {
                Sought::Load(index) => forces.loads[index].name.as_str(),
                Sought::Spring(index) => forces.springs[index].name.as_str(),
                Sought::Effort(_) => "the effort",
                Sought::Spin => "spin",
            })
            .collect();
        if names.is_empty() {
            return Ok(());
        }
        Err(self
            .fault(format!("the input has no effort of its own where {} is sought", list(&names)))
            .mend("ask for what is sought, or give it a size"))
    }

    fn pair(&self, text: &str) -> Res<(LinkId, LinkId)> {
        let (by, on) =
            text.split_once(',').ok_or_else(|| self.fault("two links are expected").mend("write F(2,3)"))?;
        let (by, on) = (self.link(by)?, self.link(on)?);
        self.acts(by, on)?;
        Ok((by, on))
    }

    /// Two links have a pair, at a pin that one of them holds.
    fn acts(&self, by: LinkId, on: LinkId) -> Res<()> {
        use crate::mechanism::force::Through;
        if by == on {
            return Err(self.fault("the two links are one"));
        }
        let mechanism = &self.draft.mechanism;
        let pairs = mechanism.pairs_between(by, on);
        if pairs.is_empty() {
            let others = (0..mechanism.links.len()).map(LinkId);
            let near: Vec<String> = others
                .filter(|other| *other != by && !mechanism.pairs_between(by, *other).is_empty())
                .map(|other| format!("F({},{})", mechanism.link(by).number, mechanism.link(other).number))
                .collect();
            let fault = self.fault(format!("{} and {} have no pair", self.draft.say(by), self.draft.say(on)));
            return Err(if near.is_empty() { fault } else { fault.mend(near.join(", ")) });
        }
        for pair in pairs {
            let Through::Pin(pin) = pair else { continue };
            let Some(carrier) = mechanism.carrier(pin) else { continue };
            if mechanism.parties_at(pin).len() > 2 && carrier != by && carrier != on {
                let name = self.draft.say_point(pin);
                let what =
                    format!("{} holds the pin {name}, through which both act", self.draft.say(carrier));
                let mend = format!("ask for F({name},{})", self.draft.link(on).number);
                return Err(self.fault(what).mend(mend));
            }
        }
        Ok(())
    }

    fn action_or_scalar(&self, text: &str) -> Res<Force> {
        if text == "FS" {
            if self.draft.mechanism.forces.masses.is_empty() {
                return Err(self.fault("nothing has a mass").mend("give `masses`"));
            }
            return Ok(Force::Vector(Action::Shaking));
        }
        let (head, inside) = self.inside(text)?;
        let action = match head {
            "F" if inside == "frame" => Action::OnFrame,
            "F" => {
                let (one, other) = inside
                    .split_once(',')
                    .ok_or_else(|| self.fault("who acts on whom is missing").mend("write F(2,3)"))?;
                match (self.token(one)?, self.token(other)?) {
                    (Token::Link(by), Token::Link(on)) => {
                        self.acts(by, on)?;
                        Action::Pair { by, on }
                    }
                    (Token::Point(pin), Token::Link(link)) => {
                        self.at_pin(pin, link)?;
                        Action::OfPin(pin, link)
                    }
                    (Token::Link(link), Token::Point(pin)) => {
                        self.at_pin(pin, link)?;
                        Action::OnPin(link, pin)
                    }
                    (Token::Point(_), Token::Point(_)) => {
                        return Err(self.fault("a force is between two links, or between a pin and a link"));
                    }
                }
            }
            "Fin" => Action::Inertia(self.massive(inside)?),
            "Fc" => {
                if self.draft.mechanism.forces.spin.is_none() {
                    return Err(self.fault("nothing turns about an axis").mend("give `spin`"));
                }
                Action::Centrifugal(self.massive(inside)?)
            }
            "load" => {
                let loads = &self.draft.mechanism.forces.loads;
                let index = loads.iter().position(|load| load.name == inside).ok_or_else(|| {
                    self.fault(format!("there is no load `{inside}`"))
                        .known(inside, loads.iter().map(|load| load.name.as_str()))
                })?;
                if loads[index].is_torque() {
                    return Ok(Force::LoadTorque(index));
                }
                Action::Load(index)
            }
            _ => return Err(self.fault("only F, Fin, FS and load are forces with a line")),
        };
        Ok(Force::Vector(action))
    }

    fn at_pin(&self, pin: PointId, link: LinkId) -> Res<()> {
        let parties = self.draft.mechanism.parties_at(pin);
        let name = self.draft.say_point(pin);
        if parties.len() < 2 {
            return Err(self.fault(format!("{name} is no pin between two links")));
        }
        if !parties.contains(&link) {
            let known: Vec<String> = parties.iter().map(|l| self.draft.link(*l).number.to_string()).collect();
            return Err(self
                .fault(format!("{} does not meet the pin {name}", self.draft.say(link)))
                .mend(format!("its links are {}", known.join(", "))));
        }
        Ok(())
    }
}
