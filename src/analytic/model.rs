//! From the mechanism to scaled bodies, parameters and equations.
//!
//! Lengths are counted from a point of the mechanism and divided by a power of two near its size, times
//! by a power of two near the time of its motion, so that scaling costs no accuracy and nothing
//! overflows, whatever the units.

use std::borrow::Cow;
use std::sync;

use super::AnalyticError;
use super::constraints::{Arc, Bearing, Drive, Motion, Num, Param, Row, Site, Straight};
use super::ordering::{Group, Ordering, needed, order};
use super::slopes::{Here, Turns};
use super::tape::{Leaf, U};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{
    Direction, Form, Given, GivenPoint, Guide, GuidePoint, Input, LinkId, Mechanism, Path, Place, PointId,
    Rider, Roll, Sense, Slide,
};

/// Largest miss of an equation that only repeats what the placed points say, in mechanism sizes. The
/// scene format allows 1e-6.
pub(super) const REPEATED: f64 = 2e-6;

/// Two directions are parallel, for the question whether a guide holds a wheel on its line.
const PARALLEL: f64 = 1e-9;

/// Part of an equation's slopes below which nothing of them is left beside others.
const INDEPENDENT: f64 = 1e-9;

/// Seeds of poses without meaning.
const ANYHOW: [f64; 3] = [1.25, 17.5, 101.75];

/// A pose without meaning, by a Weyl sequence: no three of them have a special direction in common.
fn anyhow(n: usize, seed: f64) -> Vec<f64> {
    (0..n).map(|i| 2.0 * ((i as f64 + seed) * 0.618_033_988_749_894_9).fract() - 0.9).collect()
}

/// A swivelling guide: its x-axis points towards its rider.
#[derive(Debug, Clone, Copy)]
pub(super) struct Swivel {
    /// The body, whose origin is its joint.
    pub(super) body: usize,
    /// The rider.
    pub(super) rider: Site,
    /// Own angle of the guide, from the joint's foot on it towards the rider; nothing where the places of the link that
    /// rides tell how the guide lies.
    pub(super) ray: Option<f64>,
}

/// The scaled mechanism.
#[derive(Debug, Clone)]
pub(super) struct Model {
    /// What it models.
    pub(super) mechanism: sync::Arc<Mechanism>,
    /// The point from which lengths are counted, metres.
    pub(super) reference: [f64; 2],
    /// Metres per unit of length; a power of two.
    pub(super) length: f64,
    /// Seconds per unit of time; a power of two.
    pub(super) time: f64,
    /// Number of bodies: the links, and points that belong to none.
    pub(super) bodies: usize,
    /// Parameters.
    pub(super) params: Vec<Param>,
    /// Exact place of each point, if it has one.
    pub(super) places: Vec<Option<[Num; 2]>>,
    /// Each point in every body that has it; the frame first.
    pub(super) sites: Vec<Vec<Site>>,
    /// The equations that find the position.
    pub(super) position: Vec<Row>,
    /// Equations between bodies whose places are given; they must hold by themselves.
    pub(super) repeated: Vec<Row>,
    /// The equations that find the motion.
    pub(super) motion: Vec<Row>,
    /// The same with a unit rate of the only input, where that input rests.
    pub(super) unit_motion: Option<Vec<Row>>,
    /// Swivelling guides.
    pub(super) swivels: Vec<Swivel>,
    /// The bodies that are solved: all, unless the model was narrowed.
    pub(super) kept: Vec<bool>,
    /// The unknowns in each equation of the position and of the motion, since they were narrowed.
    patterns: Option<[Vec<Vec<usize>>; 2]>,
    own: Vec<Vec<[Num; 2]>>,
    slide_paths: Vec<Track>,
    roll_lines: Vec<Option<Straight>>,
    roll_radii: Vec<[Num; 2]>,
}

/// A compiled guide path.
#[derive(Debug, Clone, Copy)]
pub(super) enum Track {
    /// Straight.
    Line(Straight),
    /// An arc.
    Arc(Arc),
}

/// Where two bodies roll on each other.
#[derive(Debug, Clone, Copy)]
pub(super) enum Contact {
    /// Two circles.
    Circles { centres: [Site; 2], radii: [Num; 2], internal: bool },
    /// A circle on a line.
    Line { centre: Site, line: Straight },
}

/// Of which pair an equation is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tie {
    /// What meets at a pin, bare slots included.
    Pin(PointId),
    /// What slides, block or link, and its guide.
    Slide(usize),
    /// Two bodies that roll on each other.
    Roll(usize),
    /// A direction without meaning, of a point that is a body of its own.
    Nothing,
}

/// The power of two next to a positive number.
fn power_of_two(x: f64) -> f64 {
    if x.is_finite() && x > 0.0 { libm::ldexp(1.0, libm::ilogb(x).clamp(-500, 500)) } else { 1.0 }
}

fn malformed(what: impl Into<String>) -> AnalyticError {
    AnalyticError::Malformed { what: what.into() }
}

impl Model {
    /// Compiles the mechanism.
    pub(super) fn new(mechanism: &Mechanism) -> Result<Self, AnalyticError> {
        Self::in_unit(mechanism, None)
    }

    /// The same, in this unit of length.
    pub(super) fn in_unit(mechanism: &Mechanism, unit: Option<f64>) -> Result<Self, AnalyticError> {
        // Of the first place at which a body is, so that one at which there is none takes no digits away.
        let places = |held: bool| {
            let mut points = mechanism.points.iter().filter(move |p| {
                let of_frame = p.links.iter().all(|link| *link == LinkId::FRAME);
                !held || !of_frame || !mechanism.slides.is_empty()
            });
            points.find_map(|p| p.place.exact())
        };
        let reference = places(true).or_else(|| places(false)).map(|p| p.map(|c| c.value));
        let reference = reference.unwrap_or([0.0; 2]);
        let length = unit.unwrap_or_else(|| power_of_two(size(mechanism, reference, &|_| true, &|_| true)));
        let time = 1.0 / power_of_two(pace(mechanism, length));
        let mut model = Self {
            mechanism: sync::Arc::new(mechanism.clone()),
            reference,
            length,
            time,
            bodies: mechanism.links.len(),
            params: Vec::new(),
            places: Vec::new(),
            sites: vec![Vec::new(); mechanism.points.len()],
            position: Vec::new(),
            repeated: Vec::new(),
            motion: Vec::new(),
            unit_motion: None,
            swivels: Vec::new(),
            kept: Vec::new(),
            patterns: None,
            own: Vec::new(),
            slide_paths: Vec::new(),
            roll_lines: Vec::new(),
            roll_radii: Vec::new(),
        };
        model.check_indices()?;
        model.locate_points()?;
        model.lay_guides()?;
        model.write_position()?;
        model.motion = model.write_motion(false)?;
        if let [only] = model.mechanism.inputs.as_slice() {
            let rate = match only {
                Input::Angle { omega, .. } => omega.value,
                Input::Speed { speed, .. } => speed.value,
                Input::Slide { velocity, .. } => velocity.value,
            };
            if rate == 0.0 {
                model.unit_motion = Some(model.write_motion(true)?);
            }
        }
        model.kept = vec![true; model.bodies];
        if model.params.iter().any(|p| !p.value.is_finite() || !p.error.is_finite()) {
            return Err(malformed("a dimension is not a finite number"));
        }
        Ok(model)
    }

    /// Leaves out every body on which none of the quantities hangs, with its equations: what nobody asks for may be
    /// impossible, or possible in two ways, and changes nothing.
    pub(super) fn narrow(&mut self, quantities: &[Quantity], moves: bool) -> Result<(), AnalyticError> {
        let n = self.unknowns();
        let position = self.pattern(&self.position, 0)?;
        let motion = if moves { self.pattern(&self.motion, 1)? } else { Vec::new() };
        let forward: Vec<usize> = (0..position.len()).collect();
        let orders = [(self.order_of_position(&position, &forward), &position), (order(&motion, n), &motion)];
        let mut ready = vec![0; self.bodies];
        for (index, group) in orders[0].0.groups.iter().enumerate() {
            if !self.is_known(group) {
                group.columns.iter().for_each(|column| ready[column / 3] = ready[column / 3].max(index + 1));
            }
        }
        let mut kept = vec![false; self.bodies];
        kept[0] = true;
        for quantity in quantities {
            let (points, links) = quantity.about();
            for point in points.into_iter().flatten() {
                // One body tells where a point is: the first that is known, and not the one that it moves against.
                let sites = self.sites.get(point.0).map_or(&[][..], Vec::as_slice);
                let carriers =
                    sites.iter().map(|site| site.body).filter(|body| !links.contains(&Some(LinkId(*body))));
                let first = carriers.min_by_key(|body| ready[*body]).or(sites.first().map(|site| site.body));
                let contact = self.contact_bodies(point).into_iter().flatten();
                first.into_iter().chain(contact).for_each(|body| kept[body] = true);
            }
            for body in links.into_iter().flatten().map(|link| link.0).chain(self.arm_of(quantity)) {
                kept.get_mut(body).into_iter().for_each(|kept| *kept = true);
            }
        }
        loop {
            let mut wanted: Vec<bool> = (0..n).map(|column| kept[column / 3]).collect();
            for (ordering, pattern) in &orders {
                wanted = needed(ordering, pattern, &wanted);
            }
            let grown: Vec<bool> = wanted.chunks(3).map(|axes| axes.contains(&true)).collect();
            if grown == kept {
                break;
            }
            kept = grown;
        }
        if kept.iter().all(|kept| *kept) {
            self.patterns = moves.then_some([position, motion]);
            return Ok(());
        }
        let holds = |columns: &[usize]| columns.iter().all(|column| kept[column / 3]);
        let keep = |rows: &mut Vec<Row>, pattern: &[Vec<usize>]| {
            let mut columns = pattern.iter();
            rows.retain(|_| columns.next().is_none_or(|columns| holds(columns)));
        };
        keep(&mut self.position, &position);
        keep(&mut self.motion, &motion);
        // The same equations, driven otherwise.
        self.unit_motion.iter_mut().for_each(|rows| keep(rows, &motion));
        self.repeated.retain(|row| (0..kept.len()).all(|body| kept[body] || !row.hangs_on(body)));
        self.swivels.retain(|swivel| kept[swivel.body]);
        for sites in &mut self.sites {
            sites.retain(|site| kept[site.body]);
        }
        let held =
            |pattern: Vec<Vec<usize>>| pattern.into_iter().filter(|own| holds(own)).collect::<Vec<_>>();
        self.patterns = moves.then(|| [held(position), held(motion)]);
        self.kept = kept;
        Ok(())
    }

    /// Whether some length is beyond all proportion to another.
    pub(super) fn is_beyond_proportion(&self) -> bool {
        let mut least = f64::INFINITY;
        each_length(&self.mechanism, self.reference, &|_| true, &|_| true, &mut |x| {
            if x > 0.0 {
                least = least.min(x);
            }
        });
        self.length > BEYOND * least
    }

    /// A unit of length for the bodies that are kept and the points by which they meet, where the present one is that of
    /// something beyond all proportion, on which nothing hangs.
    pub(super) fn nearer_unit(&self, quantities: &[Quantity]) -> Option<f64> {
        let m = &self.mechanism;
        let asked =
            |point: PointId| quantities.iter().any(|quantity| quantity.about().0.contains(&Some(point)));
        // Whatever lies on a guide, or tells where one lies.
        let mut on_guide = vec![false; m.points.len()];
        for slide in &m.slides {
            let pin = if let Rider::Pin { point, .. } = slide.rider { Some(point) } else { None };
            let (mut ends, mut whole) = ([pin, None, None], &[][..]);
            match slide.guide.path {
                Path::Straight { through, direction, .. } => {
                    if let GuidePoint::Point(point) = through {
                        ends[1] = Some(point);
                    }
                    if let Direction::Toward(point) = direction {
                        ends[2] = Some(point);
                    }
                }
                Path::Arc { .. } => whole = &m.link(slide.guide.link).points,
            }
            ends.iter().flatten().chain(whole).for_each(|point| on_guide[point.0] = true);
        }
        let kept = |link: LinkId| self.kept.get(link.0).copied().unwrap_or(true);
        let meets = |point: PointId| {
            let links = &m.point(point).links;
            links.len() > 1 && links.iter().any(|link| *link != LinkId::FRAME && kept(*link))
        };
        let counts = |point: PointId| meets(point) || asked(point) || on_guide[point.0];
        let size = size(m, self.reference, &kept, &counts);
        let unit = power_of_two(size);
        (size > 0.0 && self.length > BEYOND * unit).then_some(unit)
    }

    /// The order in which the equations of the position are solved. Of more equations than unknowns those are left out
    /// that follow from the ones before them wherever the bodies are: two points of a link that both coincide with those
    /// of another link say three things, not four, though four unknowns stand in them. Those that come before others do so
    /// in `sequence`.
    pub(super) fn order_of_position(&self, pattern: &[Vec<usize>], sequence: &[usize]) -> Ordering {
        let n = self.unknowns();
        let in_sequence: Vec<Vec<usize>> = sequence.iter().map(|row| pattern[*row].clone()).collect();
        let whole = order(&in_sequence, n);
        let mut chosen = if whole.spare.is_empty() {
            whole
        } else {
            let independent = self.independent(sequence);
            let masked: Vec<Vec<usize>> = in_sequence
                .into_iter()
                .zip(independent)
                .map(|(columns, independent)| if independent { columns } else { Vec::new() })
                .collect();
            let some = order(&masked, n);
            if some.free.len() > whole.free.len() { whole } else { some }
        };
        for rows in chosen.groups.iter_mut().map(|group| &mut group.rows).chain([&mut chosen.spare]) {
            rows.iter_mut().for_each(|row| *row = sequence[*row]);
            rows.sort_unstable();
        }
        chosen
    }

    /// Which equations of the position do not follow from those before them, where the bodies stand anyhow: rank is
    /// greatest at a pose without meaning. By elimination with the largest slope left.
    fn independent(&self, sequence: &[usize]) -> Vec<bool> {
        let n = self.unknowns();
        let (pose, turns) = (anyhow(n, ANYHOW[1]), Turns::new(self.bodies));
        let mut pivots: Vec<(usize, Vec<(usize, f64)>)> = Vec::new();
        let mut slopes = vec![0.0; n];
        let mut eliminate = |row: &Row| {
            slopes.fill(0.0);
            match Here::evaluate(row, &pose, &self.params, &turns) {
                Some(slope) => slope.columns_and_slopes(row).for_each(|(column, d)| slopes[column] += d),
                None => {
                    let motion = Motion { pose: &pose, rate: &[], accel: &[], params: &self.params };
                    let Some(linear) = row.linear(motion, 0) else { return true };
                    for (leaf, d) in &linear.terms {
                        if let Leaf::Pose(column) = leaf {
                            slopes[*column] += d;
                        }
                    }
                }
            }
            let size = slopes.iter().fold(0.0_f64, |size, d| size.max(d.abs()));
            for (column, pivot) in &pivots {
                let factor = slopes[*column];
                if factor != 0.0 {
                    pivot.iter().for_each(|(column, d)| slopes[*column] -= factor * d);
                    slopes[*column] = 0.0;
                }
            }
            let largest = (0..n).max_by(|a, b| slopes[*a].abs().total_cmp(&slopes[*b].abs()));
            let Some(column) = largest.filter(|column| slopes[*column].abs() > INDEPENDENT * size) else {
                return false;
            };
            let by = slopes[column];
            let all = slopes.iter().enumerate().filter(|(_, d)| d.abs() > INDEPENDENT * size);
            pivots.push((column, all.map(|(column, d)| (column, d / by)).collect()));
            true
        };
        sequence.iter().map(|row| eliminate(&self.position[*row])).collect()
    }

    /// Whether a group of the position is a coordinate that is zero by its form, wherever it stands among the others.
    pub(super) fn is_known(&self, group: &Group) -> bool {
        matches!(group.rows.as_slice(), [row] if matches!(self.position[*row], Row::Hold(_)))
    }

    /// The body in which a vector between two points is read, where it is one of one link.
    fn arm_of(&self, quantity: &Quantity) -> Option<usize> {
        let m = &self.mechanism;
        let bodies = |p: PointId| self.sites.get(p.0).into_iter().flatten().map(|site| site.body);
        match *quantity {
            Quantity::RelativeNormal(p, o) | Quantity::RelativeTangential(p, o) => {
                bodies(p).find(|body| *body < m.links.len() && bodies(o).any(|other| other == *body))
            }
            Quantity::Normal(p) | Quantity::Tangential(p) => bodies(p)
                .filter(|body| *body < m.links.len())
                .find(|body| m.links[*body].points.iter().any(|point| m.is_fixed(*point))),
            _ => None,
        }
    }

    /// A rough place in scaled units.
    pub(super) fn scaled(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| (place[i] - self.reference[i]) / self.length)
    }

    /// The number of unknowns (those of the frame included, which no equation names).
    pub(super) fn unknowns(&self) -> usize {
        3 * self.bodies
    }

    /// Own coordinates of a point of a link.
    pub(super) fn own(&self, link: LinkId, point: PointId) -> Option<[Num; 2]> {
        let at = self.mechanism.links.get(link.0)?.points.iter().position(|p| *p == point)?;
        self.own.get(link.0)?.get(at).copied()
    }

    /// The unknowns in each equation of the position.
    pub(super) fn pattern_of_position(&self) -> Result<Cow<'_, [Vec<usize>]>, AnalyticError> {
        match &self.patterns {
            Some([position, _]) => Ok(Cow::Borrowed(position)),
            None => self.pattern(&self.position, 0).map(Cow::Owned),
        }
    }

    /// The unknowns in each equation of a motion.
    pub(super) fn pattern_of_motion(
        &self,
        equations: &[Row],
    ) -> Result<Cow<'_, [Vec<usize>]>, AnalyticError> {
        match &self.patterns {
            Some([_, motion]) if std::ptr::eq(equations, self.motion.as_slice()) => Ok(Cow::Borrowed(motion)),
            _ => self.pattern(equations, 1).map(Cow::Owned),
        }
    }

    /// The unknowns in each equation, at any position: read off three positions without meaning.
    fn pattern(&self, rows: &[Row], order: u8) -> Result<Vec<Vec<usize>>, AnalyticError> {
        let n = self.unknowns();
        let poses = ANYHOW.map(|seed| (anyhow(n, seed), Turns::new(self.bodies)));
        let rest = vec![0.0; n];
        rows.iter()
            .map(|row| {
                let mut columns = Vec::new();
                for (pose, turns) in &poses {
                    // The rate of an equation depends on the rate of a coordinate as itself on the coordinate.
                    if let Some(slope) = Here::evaluate(row, pose, &self.params, turns) {
                        columns.extend(slope.columns(row));
                        continue;
                    }
                    let motion = Motion { pose, rate: &rest, accel: &rest, params: &self.params };
                    let linear = row.linear(motion, order).ok_or_else(|| malformed("a dimension is zero"))?;
                    columns.extend(linear.terms.iter().filter(|t| t.1 != 0.0).filter_map(|t| match t.0 {
                        Leaf::Pose(at) if order == 0 => Some(at),
                        Leaf::Rate(at) if order == 1 => Some(at),
                        _ => None,
                    }));
                }
                columns.sort_unstable();
                columns.dedup();
                Ok(columns)
            })
            .collect()
    }

    // --- numbers ---

    fn param(&mut self, value: f64, error: f64) -> Num {
        if error == 0.0 {
            return Num::Exact(value);
        }
        self.params.push(Param { value, error });
        Num::Param(self.params.len() - 1)
    }

    pub(super) fn given(&mut self, given: Given, unit: f64) -> Num {
        self.param(given.value / unit, given.error / unit)
    }

    fn given_length(&mut self, given: Given) -> Num {
        self.given(given, self.length)
    }

    fn given_place(&mut self, place: GivenPoint) -> [Num; 2] {
        [0, 1].map(|i| self.given_from(self.reference[i], place[i]))
    }

    pub(super) fn given_own(&mut self, link: LinkId, own: GivenPoint) -> [Num; 2] {
        if link == LinkId::FRAME || matches!(self.mechanism.links[link.0].form, Form::Placed) {
            return self.given_place(own);
        }
        let origin = first_joint(&self.mechanism.links[link.0].form);
        [0, 1].map(|i| self.given_from(origin[i], own[i]))
    }

    /// A coordinate counted from an origin near by, so that a figure far from its own axes' origin keeps its digits.
    fn given_from(&mut self, origin: f64, coordinate: Given) -> Num {
        let shifted = coordinate.value - origin;
        let rounding = if origin == 0.0 || shifted == 0.0 { 0.0 } else { U * shifted.abs() };
        self.param(shifted / self.length, (coordinate.error + rounding) / self.length)
    }

    fn value(&self, num: Num) -> f64 {
        match num {
            Num::Exact(value) => value,
            Num::Param(at) => self.params[at].value,
        }
    }

    // --- points ---

    fn check_indices(&self) -> Result<(), AnalyticError> {
        let m = &self.mechanism;
        let link = |id: LinkId| id.0 < m.links.len();
        let point = |id: PointId| id.0 < m.points.len();
        let guide_point = |p: &GuidePoint| !matches!(p, GuidePoint::Point(id) if !point(*id));
        let guide = |g: &Guide| {
            link(g.link)
                && match &g.path {
                    Path::Straight { through, direction, .. } => {
                        guide_point(through) && !matches!(direction, Direction::Toward(id) if !point(*id))
                    }
                    Path::Arc { centre, .. } => guide_point(centre),
                }
        };
        let fine = !m.links.is_empty()
            && m.links.iter().all(|l| l.points.iter().all(|p| point(*p)))
            && m.points.iter().all(|p| p.links.iter().all(|l| link(*l)))
            && m.pins.iter().all(|p| point(p.point) && p.links.iter().all(|l| link(*l)))
            && m.slides.iter().all(|s| {
                guide(&s.guide)
                    && match s.rider {
                        Rider::Pin { point: p, block } => point(p) && block.is_none_or(link),
                        Rider::Link { link: l, .. } => link(l) && !m.links[l.0].points.is_empty(),
                    }
            })
            && m.rolls.iter().all(|r| match r {
                Roll::Circles { links, centres, .. } => {
                    links.iter().all(|l| link(*l)) && centres.iter().all(|p| point(*p))
                }
                Roll::Line { guide: g, wheel, centre, .. } => guide(g) && link(*wheel) && point(*centre),
            })
            && m.inputs.iter().all(|i| match i {
                Input::Angle { link: l, .. } => link(*l),
                Input::Speed { link: l, point: p, .. } => link(*l) && point(*p),
                Input::Slide { slide, .. } => *slide < m.slides.len(),
            });
        if fine { Ok(()) } else { Err(malformed("an index names nothing")) }
    }

    fn locate_points(&mut self) -> Result<(), AnalyticError> {
        let mechanism = sync::Arc::clone(&self.mechanism);
        for point in &mechanism.points {
            let place = point.place.exact().map(|place| self.given_place(place));
            self.places.push(place);
        }
        for (index, link) in mechanism.links.iter().enumerate() {
            let own = self.own_coordinates(index, link)?;
            if own.len() < link.points.len() {
                return Err(malformed(format!("link {} has more points than dimensions", link.number)));
            }
            self.own.push(own);
        }
        for (index, point) in mechanism.points.iter().enumerate() {
            let id = PointId(index);
            if let (Place::Fixed(_), Some(own)) = (point.place, self.places[index]) {
                self.sites[index].push(Site { body: 0, own });
            }
            for link in point.links.iter().filter(|l| **l != LinkId::FRAME) {
                let own = self
                    .own(*link, id)
                    .ok_or_else(|| malformed(format!("{} is not in its link", point.name)))?;
                self.sites[index].push(Site { body: link.0, own });
            }
            if self.stands_alone(id) {
                // First, so that who asks for the pin asks this body.
                self.sites[index].insert(0, Site { body: self.bodies, own: [Num::Exact(0.0); 2] });
                self.bodies += 1;
            }
        }
        Ok(())
    }

    /// Whether a pin needs a body of its own: where no link has it, and where its guides and drives alone say where it
    /// is, whichever way its links turn.
    fn stands_alone(&self, id: PointId) -> bool {
        let m = &self.mechanism;
        let on = |slide: &Slide| matches!(slide.rider, Rider::Pin { point, .. } if point == id);
        let blocks: Vec<Option<LinkId>> = m
            .slides
            .iter()
            .filter(|slide| on(slide))
            .filter_map(|slide| match slide.rider {
                Rider::Pin { block, .. } => Some(block),
                Rider::Link { .. } => None,
            })
            .collect();
        if m.is_fixed(id) || blocks.is_empty() {
            return false;
        }
        let driven = m.inputs.iter().filter(
            |input| matches!(input, Input::Slide { slide, .. } if m.slides.get(*slide).is_some_and(on)),
        );
        // A block that all of them guide and drive is such a body.
        let one_block = blocks[0].is_some() && blocks.iter().all(|block| *block == blocks[0]);
        self.sites[id.0].is_empty() || (!one_block && blocks.len() + driven.count() > 1)
    }

    fn own_coordinates(
        &mut self,
        index: usize,
        link: &crate::mechanism::Link,
    ) -> Result<Vec<[Num; 2]>, AnalyticError> {
        let mut own = self.own_of_form(index, link)?;
        if !link.extra.is_empty() {
            let first = first_joint(&link.form);
            own.extend(link.extra.iter().map(|p| [0, 1].map(|i| self.given_from(first[i], p[i]))));
        }
        Ok(own)
    }

    fn own_of_form(
        &mut self,
        index: usize,
        link: &crate::mechanism::Link,
    ) -> Result<Vec<[Num; 2]>, AnalyticError> {
        let zero = Num::Exact(0.0);
        let origin = [zero; 2];
        if index == 0 || matches!(link.form, Form::Placed) {
            return link
                .points
                .iter()
                .map(|p| {
                    self.places[p.0].ok_or_else(|| {
                        let name = &self.mechanism.points[p.0].name;
                        malformed(format!("{name} of link {} has no place", link.number))
                    })
                })
                .collect();
        }
        Ok(match &link.form {
            Form::Length(length) => vec![origin, [self.given_length(*length), zero]],
            Form::Line(positions) => {
                let [first, _] = first_joint(&link.form);
                positions.iter().map(|p| [self.given_from(first, *p), zero]).collect()
            }
            Form::Sides { first_second, second_third, third_first, turn } => {
                let third = self.triangle(link.number, *first_second, *second_third, *third_first, *turn)?;
                vec![origin, [self.given_length(*first_second), zero], third]
            }
            Form::Arms { second, third, angle } => {
                let (sin, cos) = libm::sincos(angle.value);
                let arm = third.value / self.length;
                let arm_error = third.error / self.length;
                let error = |along: f64, across: f64| {
                    2.0 * (arm_error * along.abs() + (arm * across).abs() * angle.error)
                        + 3.0 * U * (arm * along).abs()
                };
                let (errors, second) = ([error(cos, sin), error(sin, cos)], self.given_length(*second));
                let place = [self.param(arm * cos, errors[0]), self.param(arm * sin, errors[1])];
                vec![origin, [second, zero], place]
            }
            Form::Shape(points) => {
                let first = first_joint(&link.form);
                points.iter().map(|p| [0, 1].map(|i| self.given_from(first[i], p[i]))).collect()
            }
            Form::Placed | Form::Single => vec![origin; link.points.len() - link.extra.len()],
        })
    }

    /// The third corner of a triangle of given sides: cosine law for x, Heron's product for y, so that
    /// flat triangles keep their accuracy.
    fn triangle(
        &mut self,
        number: u32,
        first_second: Given,
        second_third: Given,
        third_first: Given,
        turn: Sense,
    ) -> Result<[Num; 2], AnalyticError> {
        let [a, b, c] = [first_second, second_third, third_first].map(|g| g.value / self.length);
        let [ea, eb, ec] = [first_second, second_third, third_first].map(|g| g.error / self.length);
        if !(a > 0.0 && b > 0.0 && c > 0.0) {
            return Err(malformed(format!("link {number} has a side without length")));
        }
        let x = a / 2.0 + (c - b) * (c + b) / (2.0 * a);
        let x_error = 2.0 * ((0.5 - (c - b) * (c + b) / (2.0 * a * a)).abs() * ea + (b * eb + c * ec) / a)
            + 4.0 * U * (a / 2.0 + ((c - b) * (c + b) / (2.0 * a)).abs());
        let error = ea + eb + ec + 2.0 * U * (a + b + c);
        let factors = [a + b + c, (b - a) + c, (c - b) + a, (a - c) + b];
        let height = |shift: f64| {
            let product: f64 = factors.iter().map(|f| (f + shift).max(0.0)).product();
            product.sqrt() / (2.0 * a)
        };
        if factors.iter().any(|f| *f < -error) {
            let short = factors.iter().fold(0.0_f64, |worst, f| worst.min(*f));
            return Err(AnalyticError::CannotAssemble {
                links: vec![number],
                residual: -short * self.length,
            });
        }
        let y = height(0.0);
        let y_error = (height(error) - y).max(y - height(-error)) + y * (ea / a + 8.0 * U);
        let y = if turn == Sense::Cw { -y } else { y };
        Ok([self.param(x, x_error), self.param(y, y_error)])
    }

    // --- guides ---

    fn guide_site(&mut self, link: LinkId, point: &GuidePoint) -> Result<Site, AnalyticError> {
        let own = match point {
            GuidePoint::Own(own) => self.given_own(link, *own),
            GuidePoint::Point(id) => self.guide_own(link, *id)?,
        };
        Ok(Site { body: link.0, own })
    }

    fn guide_own(&self, link: LinkId, id: PointId) -> Result<[Num; 2], AnalyticError> {
        let worldly = link == LinkId::FRAME || matches!(self.mechanism.links[link.0].form, Form::Placed);
        self.own(link, id).or_else(|| if worldly { self.places[id.0] } else { None }).ok_or_else(|| {
            let m = &self.mechanism;
            malformed(format!("{} is not a point of link {}", m.points[id.0].name, m.links[link.0].number))
        })
    }

    fn line(&mut self, guide: &Guide) -> Result<Option<Straight>, AnalyticError> {
        let Path::Straight { through, direction, turned, offset } = &guide.path else { return Ok(None) };
        let through = self.guide_site(guide.link, through)?;
        let bearing = match direction {
            Direction::Angle(angle) => Bearing::Angle(self.given(*angle, 1.0)),
            Direction::Toward(point) => Bearing::Toward(self.guide_own(guide.link, *point)?),
        };
        let turned = self.given(*turned, 1.0);
        Ok(Some(Straight { through, bearing, turned, offset: self.given_length(*offset) }))
    }

    /// Own angle of a guide's direction, for structure only.
    fn own_angle(&self, line: &Straight) -> f64 {
        let base = match line.bearing {
            Bearing::Angle(angle) => self.value(angle),
            Bearing::Toward(to) => {
                let d = [0, 1].map(|i| self.value(to[i]) - self.value(line.through.own[i]));
                libm::atan2(d[1], d[0])
            }
        };
        base + self.value(line.turned)
    }

    /// How far the own angle of a line may be off by the rounding, or the room, of what states it, in radians.
    fn angle_room(&self, line: &Straight) -> f64 {
        let room = |num: Num| match num {
            Num::Exact(_) => 0.0,
            Num::Param(index) => self.params[index].error,
        };
        let base = match line.bearing {
            Bearing::Angle(angle) => room(angle),
            Bearing::Toward(to) => {
                let [dx, dy] = [0, 1].map(|i| self.value(to[i]) - self.value(line.through.own[i]));
                let rooms: f64 = to.into_iter().chain(line.through.own).map(room).sum();
                rooms / libm::hypot(dx, dy)
            }
        };
        base + room(line.turned)
    }

    /// The path of a sliding pair.
    pub(super) fn track(&self, slide: usize) -> Option<&Track> {
        self.slide_paths.get(slide)
    }

    /// Compiles every guide once, so that a given number is one parameter wherever it is used.
    fn lay_guides(&mut self) -> Result<(), AnalyticError> {
        for slide in self.mechanism.slides.clone() {
            let track = match (self.line(&slide.guide)?, slide.guide.path) {
                (Some(line), _) => Track::Line(line),
                (None, Path::Arc { centre, radius }) => Track::Arc(Arc {
                    centre: self.guide_site(slide.guide.link, &centre)?,
                    radius: self.given_length(radius),
                }),
                (None, Path::Straight { .. }) => return Err(malformed("a guide without a path")),
            };
            self.slide_paths.push(track);
        }
        for roll in self.mechanism.rolls.clone() {
            let (line, radii) = match &roll {
                Roll::Circles { radii, .. } => (None, radii.map(|r| self.given_length(r))),
                Roll::Line { guide, radius, .. } => {
                    let line = self.line(guide)?.ok_or_else(|| malformed("a rack must be straight"))?;
                    (Some(line), [self.given_length(*radius), Num::Exact(0.0)])
                }
            };
            self.roll_lines.push(line);
            self.roll_radii.push(radii);
        }
        Ok(())
    }

    /// The pin, or first joint, of a rider.
    pub(super) fn rider_point(&self, rider: &Rider) -> Option<PointId> {
        match rider {
            Rider::Pin { point, .. } => Some(*point),
            Rider::Link { link, .. } => self.mechanism.links.get(link.0)?.points.first().copied(),
        }
    }

    /// The rider's point in a body other than the guide's.
    pub(super) fn rider_site(&self, rider: &Rider, guide: LinkId) -> Result<Site, AnalyticError> {
        let found = match rider {
            Rider::Pin { point, block } => {
                let sites = &self.sites[point.0];
                sites
                    .iter()
                    .find(|s| block.is_some_and(|b| b.0 == s.body))
                    .or_else(|| sites.iter().find(|s| s.body != guide.0))
                    .copied()
            }
            Rider::Link { link, .. } => self.mechanism.links[link.0]
                .points
                .first()
                .and_then(|p| self.own(*link, *p))
                .map(|own| Site { body: link.0, own }),
        };
        found.ok_or_else(|| malformed("a rider has no link"))
    }

    /// The same where the rider's place is given: a point of the frame.
    fn placed_rider(&self, rider: &Rider, guide: LinkId) -> Result<Site, AnalyticError> {
        let place = self.rider_point(rider).and_then(|p| self.places[p.0]);
        match place {
            Some(own) => Ok(Site { body: 0, own }),
            None => self.rider_site(rider, guide),
        }
    }

    fn point_site(&self, link: LinkId, point: PointId) -> Result<Site, AnalyticError> {
        if link == LinkId::FRAME {
            return Ok(Site { body: 0, own: self.guide_own(link, point)? });
        }
        self.own(link, point)
            .map(|own| Site { body: link.0, own })
            .or_else(|| self.sites[point.0].first().copied())
            .ok_or_else(|| malformed(format!("{} is in no link", self.mechanism.points[point.0].name)))
    }

    fn placed_site(&self, link: LinkId, point: PointId) -> Result<Site, AnalyticError> {
        match self.places[point.0] {
            Some(own) => Ok(Site { body: 0, own }),
            None => self.point_site(link, point),
        }
    }

    // --- equations ---

    /// The equations of the sliding pairs; with `placed`, points of given place count as points of the
    /// frame and riders that ride as placed have no equation of direction.
    fn slide_rows(&mut self, placed: bool) -> Result<Vec<Row>, AnalyticError> {
        let mut rows = Vec::new();
        for index in 0..self.mechanism.slides.len() {
            rows.extend(self.rows_of_slide(index, placed)?);
        }
        Ok(rows)
    }

    fn rows_of_slide(&mut self, index: usize, placed: bool) -> Result<Vec<Row>, AnalyticError> {
        let mut rows = Vec::new();
        {
            let slide = self.mechanism.slides[index];
            let site = if placed {
                self.placed_rider(&slide.rider, slide.guide.link)?
            } else {
                self.rider_site(&slide.rider, slide.guide.link)?
            };
            let follower = match slide.rider {
                Rider::Pin { block, .. } => block.map(|b| (b.0, Some(Num::Exact(0.0)))),
                Rider::Link { link, turned } => {
                    let as_placed = matches!(self.mechanism.links[link.0].form, Form::Placed);
                    let turned = turned.filter(|_| !as_placed).map(|angle| self.given(angle, 1.0));
                    Some((link.0, turned))
                }
            };
            let follower = follower.filter(|(_, turned)| !placed || turned.is_some());
            match self.slide_paths[index] {
                Track::Line(line) => {
                    rows.push(Row::OnLine(site, line));
                    rows.extend(follower.map(|(body, turned)| Row::Along(body, line, turned)));
                }
                Track::Arc(arc) => {
                    rows.push(Row::OnArc(site, arc));
                    rows.extend(follower.map(|(body, turned)| Row::Around(body, site, arc, turned)));
                }
            }
        }
        Ok(rows)
    }

    /// The distance of the bodies of a rolling pair, as an equation.
    pub(super) fn distance_row(&self, roll: usize) -> Result<Row, AnalyticError> {
        self.touch_row(roll, false)
    }

    fn touch_row(&self, roll: usize, placed: bool) -> Result<Row, AnalyticError> {
        let find = |link, point| {
            if placed { self.placed_site(link, point) } else { self.point_site(link, point) }
        };
        let radii = self.roll_radii[roll];
        Ok(match (&self.mechanism.rolls[roll], self.roll_lines[roll]) {
            (Roll::Circles { links, centres, internal, .. }, _) => Row::Touch {
                centres: [find(links[0], centres[0])?, find(links[1], centres[1])?],
                radii,
                internal: *internal,
            },
            (Roll::Line { wheel, centre, .. }, Some(line)) => {
                Row::TouchLine { centre: find(*wheel, *centre)?, line, radius: radii[0] }
            }
            (Roll::Line { .. }, None) => return Err(malformed("a rack without a line")),
        })
    }

    fn roll_row(&self, roll: usize) -> Result<Row, AnalyticError> {
        let radii = self.roll_radii[roll];
        Ok(match (&self.mechanism.rolls[roll], self.roll_lines[roll]) {
            (Roll::Circles { links, centres, internal, .. }, _) => Row::Roll {
                bodies: links.map(|l| l.0),
                centres: [self.point_site(links[0], centres[0])?, self.point_site(links[1], centres[1])?],
                radii,
                internal: *internal,
            },
            (Roll::Line { wheel, centre, .. }, Some(line)) => Row::RollLine {
                wheel: wheel.0,
                centre: self.point_site(*wheel, *centre)?,
                line,
                radius: radii[0],
            },
            (Roll::Line { .. }, None) => return Err(malformed("a rack without a line")),
        })
    }

    /// Whether some other pair visibly keeps the rolling bodies at their distance.
    fn distance_is_held(&self, roll: usize) -> bool {
        let bodies_of =
            |point: PointId| -> Vec<usize> { self.sites[point.0].iter().map(|s| s.body).collect() };
        let slides = &self.mechanism.slides;
        match (&self.mechanism.rolls[roll], self.roll_lines[roll]) {
            (Roll::Circles { centres, .. }, _) => {
                let [first, second] = centres.map(bodies_of);
                // A link of both centres, or a centre that rides on an arc about the other.
                first.iter().any(|b| second.contains(b))
                    || slides.iter().any(|s| {
                        let Path::Arc { centre: GuidePoint::Point(about), .. } = s.guide.path else {
                            return false;
                        };
                        self.rider_point(&s.rider)
                            .is_some_and(|p| [p, about] == *centres || [about, p] == *centres)
                    })
            }
            (Roll::Line { guide, centre, .. }, Some(line)) => {
                let carriers = bodies_of(*centre);
                let line_angle = self.own_angle(&line);
                carriers.contains(&guide.link.0)
                    || slides.iter().zip(&self.slide_paths).any(|(slide, track)| {
                        let Track::Line(path) = track else { return false };
                        let same_body = slide.guide.link == guide.link;
                        let across = self.own_angle(path) - line_angle;
                        let room = self.angle_room(path) + self.angle_room(&line);
                        // The centre, or a link that only translates and has the centre, slides on the
                        // body of the line; or that body slides on one that has the centre.
                        let tilt = match slide.rider {
                            Rider::Pin { point, .. } if point == *centre && same_body => across,
                            Rider::Link { link, .. } if carriers.contains(&link.0) && same_body => across,
                            Rider::Link { link, turned }
                                if link == guide.link && carriers.contains(&slide.guide.link.0) =>
                            {
                                let is_placed =
                                    |link: LinkId| matches!(self.mechanism.link(link).form, Form::Placed);
                                match turned.filter(|_| !is_placed(link)) {
                                    Some(turned) => turned.value + line_angle,
                                    None if slide.guide.link == LinkId::FRAME
                                        || is_placed(slide.guide.link) =>
                                    {
                                        across
                                    }
                                    // What rides as placed does not tell how it lies on a link with axes of its own; a
                                    // rack that is not parallel to its guide would come off its wheel.
                                    None => return true,
                                }
                            }
                            _ => return false,
                        };
                        libm::sin(tilt).abs() < PARALLEL + room
                    })
            }
            (Roll::Line { .. }, None) => true,
        }
    }

    /// Whether a rolling pair moves here and nothing holds its bodies at their distance but what they are made of.
    pub(super) fn rolls_open(&self, roll: usize) -> bool {
        let bodies = self.mechanism.rolls[roll].bodies();
        let moves = bodies.iter().all(|link| self.kept.get(link.0).copied().unwrap_or(true));
        moves && !self.distance_is_held(roll)
    }

    /// The rolling pairs whose contact is an equation of its own: those held by nothing else, as far as
    /// equations are missing.
    fn contacts(&self, missing: usize) -> Vec<usize> {
        (0..self.mechanism.rolls.len()).filter(|roll| !self.distance_is_held(*roll)).take(missing).collect()
    }

    fn floating(&self) -> std::ops::Range<usize> {
        self.mechanism.links.len()..self.bodies
    }

    /// The pins with a body of their own that links have as well: in that body, and in the first link.
    fn lone_pins(&self) -> Vec<(usize, [Site; 2])> {
        let own = self.floating();
        let pairs = self.sites.iter().enumerate().filter_map(|(point, sites)| match sites.as_slice() {
            [alone, link, ..] if own.contains(&alone.body) => Some((point, [*alone, *link])),
            _ => None,
        });
        pairs.collect()
    }

    fn input_row(&mut self, input: &Input, placed: bool, unit: bool) -> Result<Option<Row>, AnalyticError> {
        let zero = Num::Exact(0.0);
        let time = self.time;
        // At position level an input without a value says nothing; later its value says nothing.
        let value = match input {
            Input::Angle { angle, .. } | Input::Speed { angle, .. } => angle.map(|a| (a, 1.0)),
            Input::Slide { at, .. } => at.map(|a| (a, self.length)),
        };
        let value = match (placed, value) {
            (true, None) => return Ok(None),
            (true, Some((given, scale))) => self.given(given, scale),
            (false, _) => zero,
        };
        let mut drive = Drive { value, rate: zero, arm: None, second: zero };
        if unit {
            drive.rate = Num::Exact(1.0);
        } else if !placed {
            match *input {
                Input::Angle { omega, alpha, .. } => {
                    drive.rate = self.given(omega, 1.0 / time);
                    drive.second = self.given(alpha, 1.0 / (time * time));
                }
                Input::Speed { link, point, speed, alpha, .. } => {
                    let first = self.mechanism.links[link.0].points.first().copied();
                    let ends = first.and_then(|f| Some([self.own(link, f)?, self.own(link, point)?]));
                    drive.arm = Some(ends.ok_or_else(|| malformed("a driven point is not in its link"))?);
                    drive.rate = self.given(speed, self.length / time);
                    drive.second = self.given(alpha, 1.0 / (time * time));
                }
                Input::Slide { velocity, acceleration, .. } => {
                    drive.rate = self.given(velocity, self.length / time);
                    drive.second = self.given(acceleration, self.length / (time * time));
                }
            }
        }
        Ok(Some(match input {
            Input::Angle { link, .. } | Input::Speed { link, .. } => {
                let form = &self.mechanism.links[link.0].form;
                let along_x =
                    matches!(form, Form::Length(_) | Form::Sides { .. } | Form::Arms { .. } | Form::Single)
                        || !placed;
                let count = self.mechanism.links[link.0].joints().len();
                let joints = match self.own.get(link.0).and_then(|own| own.get(..count)) {
                    Some([first, second, ..]) if !along_x => Some([*first, *second]),
                    _ => None,
                };
                Row::Turn(link.0, joints, drive)
            }
            Input::Slide { slide, .. } => {
                let pair = self.mechanism.slides[*slide];
                let site = if placed {
                    self.placed_rider(&pair.rider, pair.guide.link)?
                } else {
                    self.rider_site(&pair.rider, pair.guide.link)?
                };
                let Track::Line(line) = self.slide_paths[*slide] else {
                    return Err(malformed("a driven slide must be straight"));
                };
                Row::Push(site, line, drive)
            }
        }))
    }

    /// The contact that a point names, which is of no link; `None` where its bodies were not solved for.
    pub(super) fn contact(&self, point: PointId) -> Option<Contact> {
        self.contact_of(point).filter(|contact| match contact {
            Contact::Circles { centres, .. } => centres.iter().all(|site| self.kept[site.body]),
            Contact::Line { centre, line } => self.kept[centre.body] && self.kept[line.through.body],
        })
    }

    fn contact_of(&self, point: PointId) -> Option<Contact> {
        let roll = self.mechanism.contacts.iter().position(|contact| *contact == point)?;
        match (&self.mechanism.rolls[roll], self.roll_lines[roll]) {
            (Roll::Circles { links, centres, internal, .. }, _) => {
                let [Ok(first), Ok(second)] = [0, 1].map(|i| self.point_site(links[i], centres[i])) else {
                    return None;
                };
                let (centres, radii) = ([first, second], self.roll_radii[roll]);
                Some(Contact::Circles { centres, radii, internal: *internal })
            }
            (Roll::Line { wheel, centre, .. }, Some(line)) => {
                Some(Contact::Line { centre: self.point_site(*wheel, *centre).ok()?, line })
            }
            (Roll::Line { .. }, None) => None,
        }
    }

    /// The bodies that must be known for the place of a contact.
    fn contact_bodies(&self, point: PointId) -> [Option<usize>; 2] {
        match self.contact(point) {
            Some(Contact::Circles { centres, .. }) => centres.map(|site| Some(site.body)),
            Some(Contact::Line { centre, line }) => [Some(centre.body), Some(line.through.body)],
            None => [None; 2],
        }
    }

    /// The equations of motion.
    fn write_motion(&mut self, unit: bool) -> Result<Vec<Row>, AnalyticError> {
        // Where there are too many equations the first are kept: the inputs before the pairs.
        let mut rows = Vec::new();
        for input in self.mechanism.inputs.clone() {
            rows.extend(self.input_row(&input, false, unit)?);
        }
        for pin in self.mechanism.pins.clone() {
            let [a, b] = pin.links;
            let ends = [self.point_site(a, pin.point)?, self.point_site(b, pin.point)?];
            rows.extend([0, 1].map(|axis| Row::Coincide(ends[0], ends[1], axis)));
        }
        for (_, [alone, link]) in self.lone_pins() {
            rows.extend([0, 1].map(|axis| Row::Coincide(alone, link, axis)));
        }
        rows.extend(self.slide_rows(false)?);
        rows.extend(self.floating().map(|body| Row::Hold(3 * body + 2)));
        for roll in 0..self.mechanism.rolls.len() {
            rows.push(self.roll_row(roll)?);
        }
        let missing = (3 * (self.bodies - 1)).saturating_sub(rows.len());
        for roll in self.contacts(missing) {
            rows.push(self.touch_row(roll, false)?);
        }
        Ok(rows)
    }

    /// The equations of all pairs, without those of inputs, each with its pair.
    pub(super) fn pair_rows(&mut self) -> Result<Vec<(Row, Tie)>, AnalyticError> {
        let mut rows = Vec::new();
        for pin in self.mechanism.pins.clone() {
            let [a, b] = pin.links;
            let ends = [self.point_site(a, pin.point)?, self.point_site(b, pin.point)?];
            rows.extend([0, 1].map(|axis| (Row::Coincide(ends[0], ends[1], axis), Tie::Pin(pin.point))));
        }
        for (point, [alone, link]) in self.lone_pins() {
            let tie = Tie::Pin(PointId(point));
            rows.extend([0, 1].map(|axis| (Row::Coincide(alone, link, axis), tie)));
        }
        for index in 0..self.mechanism.slides.len() {
            let tie = match self.mechanism.slides[index].rider {
                Rider::Pin { point, block: None } => Tie::Pin(point),
                Rider::Pin { .. } | Rider::Link { .. } => Tie::Slide(index),
            };
            rows.extend(self.rows_of_slide(index, false)?.into_iter().map(|row| (row, tie)));
        }
        rows.extend(self.floating().map(|body| (Row::Hold(3 * body + 2), Tie::Nothing)));
        for roll in 0..self.mechanism.rolls.len() {
            rows.push((self.roll_row(roll)?, Tie::Roll(roll)));
        }
        let known = rows.len() + self.mechanism.inputs.len();
        for roll in self.contacts((3 * (self.bodies - 1)).saturating_sub(known)) {
            rows.push((self.touch_row(roll, false)?, Tie::Roll(roll)));
        }
        Ok(rows)
    }

    /// The equations of position.
    fn write_position(&mut self) -> Result<(), AnalyticError> {
        let mut rows = Vec::new();
        for input in self.mechanism.inputs.clone() {
            rows.extend(self.input_row(&input, true, false)?);
        }
        let mut known = vec![false; self.bodies];
        known[0] = true;
        for (body, known) in known.iter_mut().enumerate().take(self.mechanism.links.len()).skip(1) {
            *known = self.anchor(body, &mut rows);
        }
        for body in self.floating() {
            rows.push(Row::Hold(3 * body + 2));
        }
        for index in 0..self.mechanism.points.len() {
            let site = self.sites[index].first().copied();
            if let (Some(own), Some(site)) =
                (self.places[index], site.filter(|s| self.floating().contains(&s.body)))
            {
                let place = Site { body: 0, own };
                rows.extend([0, 1].map(|axis| Row::Coincide(site, place, axis)));
            }
        }
        for pin in self.mechanism.pins.clone() {
            if self.places[pin.point.0].is_none() {
                let ends = pin.links.map(|link| self.point_site(link, pin.point));
                let [a, b] = ends;
                let (a, b) = (a?, b?);
                rows.extend([0, 1].map(|axis| Row::Coincide(a, b, axis)));
            }
        }
        for (point, [alone, link]) in self.lone_pins() {
            if self.places[point].is_none() {
                rows.extend([0, 1].map(|axis| Row::Coincide(alone, link, axis)));
            }
        }
        rows.extend(self.slide_rows(true)?);
        let rolls = self.mechanism.rolls.len();
        let contacts = self.contacts(rolls);
        for roll in 0..rolls {
            let row = self.touch_row(roll, true)?;
            if contacts.contains(&roll) { rows.push(row) } else { self.repeated.push(row) }
        }
        self.find_swivels(&known)?;
        for (index, link) in self.mechanism.links.iter().enumerate().skip(1) {
            let id = LinkId(index);
            let directed = self.mechanism.inputs.iter().any(|i| {
                matches!(i, Input::Angle { link, angle: Some(_), .. } | Input::Speed { link, angle: Some(_), .. }
                    if *link == id)
            }) || self.mechanism.slides.iter().any(|s| match s.rider {
                Rider::Link { link, turned } => link == id && turned.is_some(),
                Rider::Pin { block, .. } => block == Some(id),
            }) || self.swivels.iter().any(|s| s.body == index);
            if matches!(link.form, Form::Single) && !directed {
                rows.push(Row::Hold(3 * index + 2));
            }
        }
        let (repeated, needed): (Vec<Row>, Vec<Row>) = rows.into_iter().partition(|row| {
            let anchors = matches!(row, Row::Aim(..) | Row::Hold(_));
            let to_place = match row {
                // The two equations that bring a body's point to its given place.
                Row::Coincide(a, b, _) => a.body == 0 || b.body == 0,
                _ => false,
            };
            !anchors && !to_place && row.bodies().iter().all(|b| known[*b])
        });
        self.position = needed;
        // Of more equations than unknowns the earlier ones are kept. Those of a direction alone come first: they are
        // linear, and what a guide says of a point need not say anything of its link's direction.
        if self.position.len() > 3 * (self.bodies - 1) {
            self.position.sort_by_key(|row| {
                !matches!(row, Row::Turn(..) | Row::Along(..) | Row::Hold(_) | Row::Aim(..))
            });
        }
        self.repeated.extend(repeated);
        Ok(())
    }

    /// The equations of a link from its points of given place; whether they determine it.
    fn anchor(&self, body: usize, rows: &mut Vec<Row>) -> bool {
        let link = &self.mechanism.links[body];
        if matches!(link.form, Form::Placed) {
            rows.extend([0, 1, 2].map(|axis| Row::Hold(3 * body + axis)));
            return true;
        }
        let exact: Vec<([Num; 2], [Num; 2])> = link
            .points
            .iter()
            .zip(&self.own[body])
            .filter_map(|(point, own)| Some((*own, self.places[point.0]?)))
            .collect();
        let Some(first) = exact.first() else { return false };
        let site = Site { body, own: first.0 };
        let place = Site { body: 0, own: first.1 };
        rows.extend([0, 1].map(|axis| Row::Coincide(site, place, axis)));
        // The farthest other point gives the best direction.
        let distance = |own: &[Num; 2]| {
            libm::hypot(
                self.value(own[0]) - self.value(first.0[0]),
                self.value(own[1]) - self.value(first.0[1]),
            )
        };
        let far = exact.iter().skip(1).max_by(|a, b| distance(&a.0).total_cmp(&distance(&b.0)));
        match far {
            Some(far) if distance(&far.0) > 0.0 => {
                rows.push(Row::Aim(body, [first.0, far.0], [first.1, far.1]));
                true
            }
            _ => false,
        }
    }

    /// The guides that swivel about the joint of their link; `known` says which bodies stand by their places.
    fn find_swivels(&mut self, known: &[bool]) -> Result<(), AnalyticError> {
        for (index, slide) in self.mechanism.slides.clone().into_iter().enumerate() {
            let body = slide.guide.link.0;
            let link = &self.mechanism.links[body];
            if !matches!(link.form, Form::Single) || self.swivels.iter().any(|s| s.body == body) {
                continue;
            }
            let id = slide.guide.link;
            let Path::Straight { through, .. } = slide.guide.path else { continue };
            let own_joint = match through {
                GuidePoint::Point(point) => link.points.first() == Some(&point),
                GuidePoint::Own(own) => own[0].value == 0.0 && own[1].value == 0.0,
            };
            let driven = self.mechanism.inputs.iter().any(|i| {
                matches!(i, Input::Angle { link, angle: Some(_), .. } | Input::Speed { link, angle: Some(_), .. }
                    if *link == id)
            });
            let rides = self.mechanism.slides.iter().any(|s| match s.rider {
                Rider::Link { link, .. } => link == id,
                Rider::Pin { block, .. } => block == Some(id),
            });
            if !own_joint || driven || rides {
                continue;
            }
            let Track::Line(line) = self.slide_paths[index] else { continue };
            let angle = self.own_angle(&line);
            // Of the two ends of the guide that further along x; where it is square to x, the guide's own direction.
            let ray = if libm::cos(angle) < -1e-6 { angle + std::f64::consts::PI } else { angle };
            let told = matches!(slide.rider, Rider::Link { link, turned: Some(_) } if known[link.0]);
            let rider = self.placed_rider(&slide.rider, id)?;
            self.swivels.push(Swivel { body, rider, ray: (!told).then_some(ray) });
        }
        Ok(())
    }
}

/// What is so many times as large as everything that is solved is beyond all proportion.
const BEYOND: f64 = 1_048_576.0;

/// The largest length in the mechanism, metres, of these links and between points that count.
pub(super) fn size(
    mechanism: &Mechanism,
    reference: [f64; 2],
    kept: &dyn Fn(LinkId) -> bool,
    counts: &dyn Fn(PointId) -> bool,
) -> f64 {
    let mut size = 0.0_f64;
    each_length(mechanism, reference, kept, counts, &mut |x| size = size.max(x));
    size
}

/// Every length that is given, or a coordinate, not negative.
fn each_length(
    mechanism: &Mechanism,
    reference: [f64; 2],
    kept: &dyn Fn(LinkId) -> bool,
    counts: &dyn Fn(PointId) -> bool,
    seen: &mut dyn FnMut(f64),
) {
    let mut see = |x: f64| seen(x.abs());
    for (index, point) in mechanism.points.iter().enumerate() {
        if let Some(place) = point.place.exact().filter(|_| counts(PointId(index))) {
            see(place[0].value - reference[0]);
            see(place[1].value - reference[1]);
        }
    }
    for (_, link) in mechanism.links.iter().enumerate().filter(|(index, _)| kept(LinkId(*index))) {
        let counted = |index: usize| link.points.get(index).is_none_or(|point| counts(*point));
        match &link.form {
            Form::Length(length) => see(length.value),
            Form::Line(positions) => {
                let positions = positions.iter().enumerate().filter(|(index, _)| counted(*index));
                positions.for_each(|(_, p)| see(p.value));
            }
            Form::Sides { first_second, second_third, third_first, .. } => {
                let sides = [([0, 1], first_second), ([1, 2], second_third), ([2, 0], third_first)];
                let sides = sides.iter().filter(|(ends, _)| ends.iter().all(|end| counted(*end)));
                sides.for_each(|(_, side)| see(side.value));
            }
            Form::Arms { second, third, .. } => {
                let arms = [(1, second), (2, third)].into_iter().filter(|(end, _)| counted(*end));
                arms.for_each(|(_, arm)| see(arm.value));
            }
            Form::Shape(points) => {
                let points = points.iter().enumerate().filter(|(index, _)| counted(*index));
                points.for_each(|(_, place)| place.iter().for_each(|g| see(g.value)));
            }
            Form::Placed | Form::Single => {}
        }
    }
    for roll in &mechanism.rolls {
        match roll {
            Roll::Circles { radii, .. } => radii.iter().for_each(|g| see(g.value)),
            Roll::Line { radius, .. } => see(radius.value),
        }
    }
}

/// The largest rate of the inputs, 1/s, in the unit of length given.
fn pace(mechanism: &Mechanism, length: f64) -> f64 {
    let rate = |first: f64, second: f64| first.abs().max(second.abs().sqrt());
    let rates = mechanism.inputs.iter().map(|input| match input {
        Input::Angle { omega, alpha, .. } => rate(omega.value, alpha.value),
        Input::Speed { speed, alpha, .. } => rate(speed.value / length, alpha.value),
        Input::Slide { velocity, acceleration, .. } => {
            rate(velocity.value / length, acceleration.value / length)
        }
    });
    rates.fold(0.0, f64::max)
}

/// Where the first joint of a link lies in its own coordinates, metres: from there its body is counted. Other figures
/// begin there.
fn first_joint(form: &Form) -> [f64; 2] {
    match form {
        Form::Line(positions) if !positions.is_empty() => [positions[0].value, 0.0],
        Form::Shape(points) if !points.is_empty() => points[0].map(|c| c.value),
        _ => [0.0; 2],
    }
}
