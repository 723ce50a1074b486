//! Figures that take arguments: `klein(3)`, `inflection(3)`.

use crate::mechanism::engine::Engine;
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, LinkId, Mechanism, PointId, Rider};
use crate::plan::Auxiliary;
use crate::scene::Scene;
use crate::scene::units::short;

/// The figures of constructions on the skeleton, with the form of their arguments.
const FORMS: [(&str, &str); 7] = [
    ("klein", "klein or klein(3), with the number of the rod"),
    ("inflection", "inflection or inflection(3), with the number of a link"),
    ("centrodes", "centrodes or centrodes(1,3), with two links"),
    ("kennedy", "kennedy or kennedy(1,2,3), with three links"),
    ("equivalent", "equivalent(3,A) or equivalent(3,A,B), with a link and where its masses stand"),
    ("lever", "lever"),
    ("rotation-centre", "rotation-centre(90) or rotation-centre(3,90), with a link and where the input goes"),
];

/// The other position of a finite rotation is walked to: not further than this, in whole turns.
const MOST_TURNS: f64 = 100.0;

/// The name of a figure without its arguments.
#[must_use]
pub fn figure_head(name: &str) -> &str {
    name.split('(').next().unwrap_or(name).trim()
}

/// The figures of forces.
const FORCES: [&str; 9] =
    ["forces", "loads", "inertia", "bodies", "body", "polygons", "polygon", "shaking", "friction"];

/// Whether a figure shows forces.
#[must_use]
pub fn is_of_forces(name: &str) -> bool {
    FORCES.contains(&figure_head(name))
}

/// Refuses a figure of forces of a link that is not there.
fn of_forces(name: &str, scene: &Scene) -> Result<(), String> {
    let head = figure_head(name);
    let takes = matches!(head, "body" | "polygon");
    let inside = name.trim().split_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).map(str::trim);
    match (takes, inside) {
        (false, Some(point)) if head == "friction" => {
            let pairs = scene.mechanism.rubbing_pairs();
            let rubs = pairs.iter().any(|pair| scene.mechanism.rubbing_name(*pair) == Some(point));
            if rubs { Ok(()) } else { Err(format!("figure {name}: nothing rubs at {point}")) }
        }
        (true, Some("all" | "frame")) if head == "polygon" => Ok(()),
        (true, Some(names)) => {
            let names: Vec<&str> = names.split(',').map(str::trim).collect();
            let known = |link: &&str| {
                let link = link.parse().ok().and_then(|n| scene.mechanism.link_numbered(n));
                link.is_some_and(|link| link != LinkId::FRAME)
            };
            // A pin of several links has its own balance.
            let is_pin = |name: &str| scene.mechanism.point_named(name).is_some();
            match (&names[..], names.iter().find(|link| !known(link))) {
                ([name], Some(_)) if is_pin(name) => Ok(()),
                ([one, other], None) if one == other => {
                    Err(format!("figure {name}: link {one} is named twice"))
                }
                ([_] | [_, _], None) => Ok(()),
                (_, Some(link)) => Err(format!("figure {name}: there is no moving link {link}")),
                _ => Err(format!("figure {name}: name one link, or two that are cut free together")),
            }
        }
        (true, None) => Err(format!("figure {name}: write {head}(3), with the number of a link")),
        (false, None) if !name.contains('(') => Ok(()),
        (false, _) => Err(format!("figure {name}: {head} takes no arguments")),
    }
}

/// The construction on the skeleton that a figure shows: none for the figures that show something else.
///
/// # Errors
/// One sentence where the arguments name nothing in the scene, or the scene has no such construction.
pub fn auxiliary(name: &str, scene: &Scene) -> Result<Option<Auxiliary>, String> {
    let head = figure_head(name);
    if is_of_forces(name) {
        return of_forces(name, scene).map(|()| None);
    }
    let Some((_, form)) = FORMS.iter().find(|(known, _)| *known == head) else {
        return match name.contains('(') {
            true => Err(format!("figure {name}: {head} takes no arguments")),
            false => Ok(None),
        };
    };
    let wrong = || format!("figure {name}: write {form}");
    let arguments: Vec<&str> = match name.trim().split_once('(') {
        None => Vec::new(),
        Some((_, inside)) => inside.strip_suffix(')').ok_or_else(wrong)?.split(',').map(str::trim).collect(),
    };
    // A mechanism that has no structure is refused with the reason when it is solved.
    let Ok(structure) = Structure::of(&scene.mechanism) else { return Ok(None) };
    let asking = Asking { name, mechanism: &scene.mechanism, structure: &structure };
    let found = match (head, arguments.as_slice()) {
        ("klein", []) => asking.klein(None),
        ("klein", [rod]) => asking.klein(Some(asking.link(rod)?)),
        ("inflection", []) => asking.inflection(None),
        ("inflection", [link]) => asking.inflection(Some(asking.link(link)?)),
        ("centrodes", []) => asking.centrodes(),
        ("centrodes", [i, j]) => {
            Ok(Auxiliary::Centrodes { links: asking.different([asking.link(i)?, asking.link(j)?])? })
        }
        ("kennedy", []) => asking.kennedy(),
        ("kennedy", [i, j, k]) => {
            let links = [asking.link(i)?, asking.link(j)?, asking.link(k)?];
            Ok(Auxiliary::Kennedy { links: asking.different(links)? })
        }
        ("equivalent", [link, first]) => asking.two_masses(asking.link(link)?, first, None),
        ("equivalent", [link, first, second]) => asking.two_masses(asking.link(link)?, first, Some(second)),
        ("lever", []) => asking.lever(),
        ("rotation-centre", [to]) => asking.rotation(None, to, scene),
        ("rotation-centre", [link, to]) => asking.rotation(Some(asking.link(link)?), to, scene),
        _ => return Err(wrong()),
    };
    found.map(Some)
}

struct Asking<'a> {
    name: &'a str,
    mechanism: &'a Mechanism,
    structure: &'a Structure,
}

impl Asking<'_> {
    fn refuse<T>(&self, why: &str) -> Result<T, String> {
        Err(format!("figure {}: {why}", self.name))
    }

    fn link(&self, number: &str) -> Result<LinkId, String> {
        let link = number.parse().ok().and_then(|n| self.mechanism.link_numbered(n));
        link.map_or_else(|| self.refuse(&format!("there is no link {number}")), Ok)
    }

    /// The slider-crank with this rod, else the first one.
    fn klein(&self, rod: Option<LinkId>) -> Result<Auxiliary, String> {
        let all = Engine::all(self.mechanism, self.structure);
        let crank = all.into_iter().find(|c| rod.is_none_or(|rod| rod == c.rod));
        match (crank, rod) {
            (Some(crank), _) => Ok(Auxiliary::Klein { crank, order: Order::Acceleration }),
            (None, Some(_)) => self.refuse("the link is not the rod of a slider-crank whose crank is driven"),
            (None, None) => self.refuse("the mechanism has no slider-crank whose crank is driven"),
        }
    }

    fn two_masses(&self, link: LinkId, first: &str, second: Option<&str>) -> Result<Auxiliary, String> {
        let Some(mass) = self.mechanism.forces.mass(link) else {
            return self.refuse("the link has no mass");
        };
        let point = |name: &str| -> Result<PointId, String> {
            let Some(point) = self.mechanism.point_named(name) else {
                return self.refuse(&format!("there is no point {name}"));
            };
            if !self.mechanism.link(link).points.contains(&point) {
                return self.refuse(&format!("{name} is no joint of the link"));
            }
            if point == mass.centre {
                return self.refuse(&format!("{name} is the mass centre"));
            }
            Ok(point)
        };
        let (first, second) = (point(first)?, second.map(point).transpose()?);
        if second == Some(first) {
            return self.refuse("the two masses stand at one point");
        }
        Ok(Auxiliary::TwoMasses { link, first, second })
    }

    fn lever(&self) -> Result<Auxiliary, String> {
        match self.mechanism.lever_refused(0) {
            Some(why) => self.refuse(why),
            None if self.mechanism.forces.is_empty() => self.refuse("nothing acts on the links"),
            None => Ok(Auxiliary::Lever { input: 0 }),
        }
    }

    fn inflection(&self, link: Option<LinkId>) -> Result<Auxiliary, String> {
        let link = match link {
            Some(link) => link,
            None => match self.coupler() {
                Some(link) => link,
                None => return self.refuse("no link moves in general; name one, as in inflection(3)"),
            },
        };
        if link == LinkId::FRAME {
            return self.refuse("the frame does not move");
        }
        if self.mechanism.link(link).points.iter().any(|&p| self.mechanism.is_fixed(p)) {
            return self.refuse("the link turns about a fixed pivot: every path is a circle about it");
        }
        Ok(Auxiliary::Inflection { link })
    }

    fn different<const N: usize>(&self, links: [LinkId; N]) -> Result<[LinkId; N], String> {
        let twice = links.iter().enumerate().any(|(n, link)| links[n + 1..].contains(link));
        if twice { self.refuse("a link is named twice") } else { Ok(links) }
    }

    /// Those of the first centre that is asked, else of the coupler in the frame.
    fn centrodes(&self) -> Result<Auxiliary, String> {
        let asked = self.mechanism.asked.iter().find_map(|a| match a.quantity {
            Quantity::Centre(i, j) if i != j => Some([i, j]),
            _ => None,
        });
        match asked.or_else(|| self.coupler().map(|link| [LinkId::FRAME, link])) {
            Some(links) => Ok(Auxiliary::Centrodes { links }),
            None => self.refuse("no link moves in general; name two, as in centrodes(1,3)"),
        }
    }

    /// The frame and two links that have no pin in common, each pivoted to it or sliding on it: two centres are seen,
    /// the third is the one on trial.
    fn kennedy(&self) -> Result<Auxiliary, String> {
        let points = |link: LinkId| self.mechanism.link(link).points.iter();
        let seen = |link: &LinkId| {
            let pivoted = points(*link).any(|&p| self.mechanism.is_fixed(p));
            let slides = self.mechanism.slides.iter().any(|s| {
                let rider = match s.rider {
                    Rider::Pin { block, .. } => block,
                    Rider::Link { link, .. } => Some(link),
                };
                s.guide.link == LinkId::FRAME && rider == Some(*link)
            });
            pivoted || slides
        };
        let all: Vec<LinkId> = self.mechanism.moving().filter(seen).collect();
        let apart = |i: LinkId, j: LinkId| !points(i).any(|p| points(j).any(|q| p == q));
        let pairs = all.iter().enumerate().flat_map(|(n, &i)| all[n + 1..].iter().map(move |&j| (i, j)));
        match pairs.into_iter().find(|&(i, j)| apart(i, j)) {
            Some((i, j)) => Ok(Auxiliary::Kennedy { links: [LinkId::FRAME, i, j] }),
            None => self.refuse("name three links, as in kennedy(1,2,3)"),
        }
    }

    fn rotation(&self, link: Option<LinkId>, to: &str, scene: &Scene) -> Result<Auxiliary, String> {
        let Some(link) = link.or_else(|| self.coupler()) else {
            return self.refuse("no link moves in general; name one, as in rotation-centre(3,90)");
        };
        if link == LinkId::FRAME {
            return self.refuse("the frame does not move");
        }
        let Some(number) = to.parse::<f64>().ok().filter(|n| n.is_finite()) else {
            return self.refuse(&format!("{to} is not a number"));
        };
        let turns = !matches!(self.mechanism.inputs.first(), Some(Input::Slide { .. }));
        let unit = if turns { scene.units.angle.si } else { scene.units.length.si };
        let to = number * unit;
        if turns && to.abs() > MOST_TURNS * std::f64::consts::TAU {
            return self.refuse(&format!(
                "the input goes to {}; name a place within {MOST_TURNS} turns of 0",
                short(number)
            ));
        }
        Ok(Auxiliary::Rotation { link, to })
    }

    /// The link that the scene asks most about among those without a fixed pivot and with two points, else the first
    /// of them in order of transmission.
    fn coupler(&self) -> Option<LinkId> {
        let asked = |link: LinkId| {
            let about = |q: &Quantity| match *q {
                Quantity::Omega(l) | Quantity::Alpha(l) | Quantity::Centre(_, l) => l == link,
                _ => false,
            };
            self.mechanism.asked.iter().filter(|a| about(&a.quantity)).count()
        };
        let order = self.structure.groups.iter().flat_map(|group| group.links.iter().copied());
        let general = order.filter(|&l| {
            let link = self.mechanism.link(l);
            link.points.len() > 1 && !link.points.iter().any(|&p| self.mechanism.is_fixed(p))
        });
        let all: Vec<LinkId> = general.collect();
        let most = all.iter().map(|&l| asked(l)).max()?;
        all.into_iter().find(|&l| asked(l) == most)
    }
}
