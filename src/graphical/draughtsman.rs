//! The draughtsman: the board, what already stands on it, and the record of his acts.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use crate::board::{Amount, Angle, Board, Point, Reason, Scale, Side, Tape};
use crate::given::Given;
use crate::mechanism::curve::Curve;
use crate::mechanism::force::{Heaviness, LoadKind, Share, Size};
use crate::mechanism::quantity::{Indeterminate, Order, Quantity, Stuck};
use crate::mechanism::structure::{Hold, Structure, Target, Trial, TrialDriver, Unknown};
use crate::mechanism::{LinkId, Mechanism, PointId, Rider};
use crate::plan::{Auxiliary, home};

use super::auxiliary::{
    AuxiliaryAct, AuxiliaryDrawing, ByLever, ByTwoMasses, Klein, NamedPoint, Stroke, StrokeRole, StrokeShape,
};
use super::centres::{Centres, FromCentres, Why};
use super::construction::{
    Act, Axes, Calculation, Centre, CircleDiagram, Claim, Construction, ConstructionLine, Diagram, Equation,
    ForceSheet, Image, Label, LinkImage, Reading, Space, Step, Transfer, Vector, VectorKind,
};
use super::departure::Departure;
use super::forces::Balance;
use super::missing::Missing;
use super::page::is_a_point;
use super::pose::Pose;
use super::rolled::Starts;
use super::trial::{Searched, Tried};
use super::{Scales, scale};

/// Images of one polygon.
pub(super) type Images = Vec<Option<Point>>;

/// What is known of the motion at one order.
#[derive(Clone)]
pub(super) struct Motion {
    /// Images of the points, by point.
    pub(super) images: Images,
    /// ω or ε of each link.
    pub(super) rotations: Vec<Option<Amount>>,
    /// The sliding velocity, or the apparent acceleration along the guide, in each pair, signed along the guide's direction
    /// under the rider, seen from the guide's link; by index of the pair.
    pub(super) slidings: Vec<Option<Amount>>,
}

/// A normal part that stands on the acceleration polygon.
pub(super) struct Foot {
    pub(super) link: LinkId,
    /// The observed and the reference point.
    pub(super) points: [PointId; 2],
    pub(super) tail: Point,
    pub(super) head: Point,
}

/// The image of the point of a link that lies under a pin of another link.
pub(super) struct Coincident {
    pub(super) order: Order,
    pub(super) pin: PointId,
    pub(super) link: LinkId,
    pub(super) image: Point,
}

/// A vector of a polygon that answers a quantity by itself.
pub(super) struct Part {
    pub(super) quantity: Quantity,
    pub(super) tail: Point,
    pub(super) head: Point,
}

/// How far a skeleton has come.
pub(super) struct Skeleton {
    pub(super) places: Vec<Option<Point>>,
    pub(super) poses: Vec<Option<Pose>>,
    pub(super) lengths: usize,
    pub(super) record: Construction,
}

/// Why what is behind a reason cannot be told.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Cause {
    /// A division fails where the links of these numbers are in line.
    InLine(Vec<u32>),
    /// Nobody has drawn it.
    Missing(Missing),
}

pub(super) struct Draughtsman<'m> {
    pub(super) mechanism: &'m Mechanism,
    pub(super) structure: &'m Structure,
    pub(super) board: Board,
    pub(super) scales: Scales,
    /// Newtons per millimetre of the force paper: a power of two.
    pub(super) per_newton: f64,
    /// The balance of forces, for each part that is asked.
    pub(super) balances: Vec<(Share, Balance)>,
    /// The part that free bodies are told of.
    pub(super) told: Share,
    /// Millimetres of the skeleton here for one of the page, for what is drawn to be looked at.
    pub(super) per_page: f64,
    /// The same on the velocity polygon.
    pub(super) per_page_of_velocities: f64,
    /// Places on the skeleton, by point.
    pub(super) places: Vec<Option<Point>>,
    /// Given places of fixed and placed points, pricked once, by point.
    pub(super) pricked: Vec<Option<Point>>,
    /// Where points are stated that the rest of the scene places: hints, by point.
    pub(super) stated_hints: Vec<Option<Point>>,
    /// The group that is being tried.
    pub(super) tried: Tried,
    /// Own figures of the links that have dimensions of their own, by link: every point of the link.
    pub(super) figures: Vec<Option<Vec<Point>>>,
    /// How the solved links stand, where that was needed.
    pub(super) poses: Vec<Option<Pose>>,
    /// Lengths already given or measured.
    pub(super) lengths: Vec<(LinkId, PointId, PointId, Amount)>,
    /// Where those of each link stand among them, as long as they do: what was rubbed out may still be named here.
    pub(super) length_at: Vec<Vec<usize>>,
    /// To which images a vector leads from the pole.
    from_pole: HashSet<(Order, Label)>,
    /// Of which links the steps of which polygon say that they do not turn.
    told_to_translate: HashSet<(Order, LinkId)>,
    /// What is known of the motion, by order.
    motions: [Motion; 2],
    /// Which links cannot turn, whatever moves: the frame, and what slides on such links without turning.
    pub(super) translates: Vec<bool>,
    /// The normal parts laid off so far.
    pub(super) feet: Vec<Foot>,
    /// Images of points of guide links under their riders.
    pub(super) coincident: Vec<Coincident>,
    /// Velocity of a rolling wheel's centre along the line on which it rolls, by index of the rolling pair.
    pub(super) rolling_speeds: Vec<Option<Amount>>,
    /// Instant centres found so far.
    pub(super) centres: Centres,
    /// Klein's constructions drawn so far.
    pub(super) kleins: Vec<Klein>,
    /// See [`crate::plan::Plan::at_contacts`].
    pub(super) at_contacts: BTreeSet<PointId>,
    pub(super) by_two_masses: Vec<ByTwoMasses>,
    pub(super) by_lever: Vec<ByLever>,
    /// What the methods of centres led to, by index of the asked quantity.
    pub(super) transferred: Vec<(usize, Result<FromCentres, Why>)>,
    /// Why the velocity diagram could not be laid off from centres, where it should have been.
    pub(super) fed: Result<(), Why>,
    /// Sliding, Coriolis and coincident vectors drawn so far.
    pub(super) parts: Vec<Part>,
    /// While a trial is on the board, nothing is recorded.
    pub(super) silent: bool,
    /// Sides that the next choices must take, in a trial.
    pub(super) sides: Option<Vec<Side>>,
    /// Where the trial drivers are tried: an angle, or millimetres along a guide; none where they are placed.
    pub(super) tried_places: Vec<(TrialDriver, Angle)>,
    /// Of a mechanism whose only input rests the rate that is assumed for it, to find instant centres by.
    pub(super) assumed_rate: Option<Given>,
    /// How groups of higher class are tried where not in the first way, by index of the trial.
    pub(super) ways: BTreeMap<usize, Trial>,
    /// How fast the trial drivers are tried, SI.
    pub(super) tried_rates: Vec<(Order, TrialDriver, Amount)>,
    /// In what this drawing departs from the right one.
    pub(super) departures: &'m [Departure],
    /// What was found by trial in drawings before.
    pub(super) searched: Option<&'m Searched>,
    /// With friction, how often each balance is drawn again where that cannot be seen from the drawing: a hand that
    /// trembles never draws the same twice.
    pub(super) redrawn: Vec<(Share, usize)>,
    /// As large as what a perfect hand finds is what is tried for it: a slip is then a small part of a trial.
    pub(super) tried_sizes: Vec<(Share, f64)>,
    /// On which side rough guides press, in a trial: by sliding pair, left of their direction or right.
    pub(super) pressed: Vec<(usize, bool)>,
    /// How its passes begin.
    pub(super) begun: super::forces::Begun,
    /// Where points stood when wheels began to roll.
    pub(super) starts: &'m Starts,
    /// How far wheels have rolled since, by link.
    pub(super) turned_by: Vec<Option<Angle>>,
    /// The first thing that was asked for and nobody has drawn.
    pub(super) missing: Option<Missing>,
    reasons: Vec<Cause>,
    /// Which points have points of other links under them.
    has_under: Vec<bool>,
    /// Where each reason stands in their list.
    reason_of: HashMap<Cause, usize>,
    /// The vectors of the velocity and the acceleration diagram by what they stand for.
    pub(super) vectors_of: [super::reading::Listed; 2],
    record: Construction,
}

/// Newtons per millimetre at which the paper numbers of the given forces are of order 100: a power of two, so that no
/// digit depends on it.
fn newtons_per_mm(mechanism: &Mechanism) -> f64 {
    let forces = &mechanism.forces;
    let loads = forces.loads.iter().flat_map(|load| match load.kind {
        LoadKind::Force { size: Size::Given(size), .. } => vec![size.value],
        LoadKind::Force { size: Size::Curve(curve), .. } => match &forces.curves[curve] {
            Curve::Table { knots, .. } => knots.iter().map(|[_, size]| size.value).collect(),
            Curve::Harmonics { constant, sin, cos } => {
                let waves = sin.iter().chain(cos).map(|wave| wave.size.value);
                waves.chain([constant.value]).collect()
            }
        },
        LoadKind::Vector { parts, .. } => parts.map(|part| part.value).to_vec(),
        _ => Vec::new(),
    });
    let masses = forces.masses.iter().map(|mass| match mass.heaviness {
        Heaviness::Mass(mass) => mass.value * forces.gravity.g.value,
        Heaviness::Weight(weight) => weight.value,
        Heaviness::None => 0.0,
    });
    let largest = loads.chain(masses).fold(0.0_f64, |most, force| most.max(force.abs()));
    let scale = largest / 100.0;
    if scale.is_normal() { libm::ldexp(1.0, libm::ilogb(scale)) } else { 1.0 }
}

/// The own axes of a link that stands so.
fn axes(pose: &Pose) -> Axes {
    let ([own_x, own_y], [x, y]) = (pose.own_along.value(), pose.along.value());
    // The turn that brings the one direction into the other.
    let turn = [own_x * x + own_y * y, own_x * y - own_y * x];
    let ([own_x, own_y], [x, y]) = (pose.own_anchor.value(), pose.anchor.value());
    let origin = [x - turn[0] * own_x + turn[1] * own_y, y - turn[1] * own_x - turn[0] * own_y];
    Axes { origin, x: turn }
}

impl<'m> Draughtsman<'m> {
    pub(super) fn new(
        board: Board,
        mechanism: &'m Mechanism,
        structure: &'m Structure,
        scales: Scales,
    ) -> Self {
        let (points, links) = (mechanism.points.len(), mechanism.links.len());
        Self {
            mechanism,
            structure,
            board,
            scales,
            per_newton: scales.paper().force.unwrap_or_else(|| newtons_per_mm(mechanism)),
            balances: Vec::new(),
            told: Share::Total,
            per_page: 1.0,
            per_page_of_velocities: 1.0,
            places: vec![None; points],
            pricked: vec![None; points],
            stated_hints: vec![None; points],
            tried: Tried::default(),
            figures: vec![None; links],
            poses: vec![None; links],
            lengths: Vec::new(),
            length_at: vec![Vec::new(); links],
            from_pole: HashSet::new(),
            told_to_translate: HashSet::new(),
            has_under: with_points_under(mechanism, structure),
            motions: [0, 1].map(|_| Motion {
                images: vec![None; points],
                rotations: vec![None; links],
                slidings: vec![None; mechanism.slides.len()],
            }),
            translates: mechanism.translating(),
            feet: Vec::new(),
            coincident: Vec::new(),
            rolling_speeds: vec![None; mechanism.rolls.len()],
            centres: Centres::default(),
            kleins: Vec::new(),
            at_contacts: BTreeSet::new(),
            by_two_masses: Vec::new(),
            by_lever: Vec::new(),
            transferred: Vec::new(),
            fed: Ok(()),
            parts: Vec::new(),
            silent: false,
            sides: None,
            tried_places: Vec::new(),
            assumed_rate: None,
            ways: BTreeMap::new(),
            tried_rates: Vec::new(),
            departures: &[],
            searched: None,
            redrawn: Vec::new(),
            tried_sizes: Vec::new(),
            pressed: Vec::new(),
            begun: super::forces::Begun::default(),
            starts: &[],
            turned_by: vec![None; links],
            missing: None,
            reasons: Vec::new(),
            reason_of: HashMap::new(),
            vectors_of: Default::default(),
            record: Construction {
                space: Space {
                    metres_per_mm: scales.length(),
                    places: vec![None; points],
                    axes: vec![None; links],
                    lines: Vec::new(),
                    choices: Vec::new(),
                },
                diagrams: Vec::new(),
                circle: None,
                forces: None,
                cycle: None,
                auxiliary: Vec::new(),
                others: Vec::new(),
                steps: Vec::new(),
                rooms: false,
                answers: Vec::new(),
            },
        }
    }

    pub(super) fn record(&self) -> &Construction {
        &self.record
    }

    /// Notes whether places are known within rooms only.
    pub(super) fn note_rooms(&mut self) {
        self.record.rooms = !self.mechanism.roomy().is_empty();
    }

    /// Notes the free bodies.
    pub(super) fn note_forces(&mut self, sheet: Option<ForceSheet>) {
        self.record.forces = sheet;
    }

    pub(super) fn finish(mut self, answers: Vec<Reading>) -> (Construction, Tape) {
        self.record.answers = answers;
        self.record.space.axes = self.axes();
        let tape = std::mem::take(self.board.tape());
        (self.record, tape)
    }

    /// How the links stand whose own axes were laid, by [`LinkId`], mm.
    pub(super) fn axes(&self) -> Vec<Option<Axes>> {
        self.poses.iter().map(|pose| pose.as_ref().map(axes)).collect()
    }

    /// What has been found of the skeleton so far, and what was recorded.
    pub(super) fn skeleton(&self) -> Skeleton {
        Skeleton {
            places: self.places.clone(),
            poses: self.poses.clone(),
            lengths: self.lengths.len(),
            record: self.record.clone(),
        }
    }

    /// Rubs out what was found and recorded since.
    pub(super) fn back_to(&mut self, before: &Skeleton) {
        self.places.clone_from(&before.places);
        self.poses.clone_from(&before.poses);
        self.lengths.truncate(before.lengths);
        self.record.clone_from(&before.record);
        self.tried = Tried::default();
        (self.sides, self.missing) = (None, None);
    }

    /// Hands the paper over to another, who draws the skeleton of this mechanism on it: it has the same points and links, and
    /// whatever is pricked stands there too.
    pub(super) fn hand_over<'n>(
        &mut self,
        mechanism: &'n Mechanism,
        structure: &'n Structure,
    ) -> Draughtsman<'n>
    where
        'm: 'n,
    {
        let board = std::mem::replace(&mut self.board, Board::scratch());
        let mut other = Draughtsman::new(board, mechanism, structure, self.scales);
        other.searched = self.searched;
        other.pricked.clone_from(&self.pricked);
        other.stated_hints.clone_from(&self.stated_hints);
        other.reasons = std::mem::take(&mut self.reasons);
        other.reason_of = std::mem::take(&mut self.reason_of);
        std::mem::swap(&mut other.record, &mut self.record);
        other.silent = self.silent;
        other
    }

    /// Takes the paper back, with what was drawn and recorded on it.
    pub(super) fn take_back(&mut self, other: Draughtsman<'_>) {
        (self.board, self.record) = (other.board, other.record);
        (self.reasons, self.reason_of) = (other.reasons, other.reason_of);
    }

    /// Rubs out what was recorded since.
    pub(super) fn begin_again_from(&mut self, before: &Construction) {
        self.record.clone_from(before);
    }

    /// What stands on the paper, without answers.
    pub(super) fn into_record(self) -> Construction {
        self.record
    }

    pub(super) fn length_scale(&self) -> Scale {
        scale(self.scales.length())
    }

    /// The scale of a polygon.
    pub(super) fn polygon_scale(&self, order: Order) -> Scale {
        scale(self.scales.of(order.dimension()))
    }

    /// A reason for a division that fails where these links are in line. A link that stands square to a guide is in line with
    /// nothing: of the two it alone is named.
    pub(super) fn reason(&mut self, links: &[LinkId]) -> Reason {
        let mechanism = self.mechanism;
        let slides_on = |rider: LinkId, guide: LinkId| {
            mechanism.slides.iter().filter(|slide| slide.guide.link == guide).any(|slide| match slide.rider {
                Rider::Pin { point, block } => {
                    block == Some(rider) || mechanism.point(point).links.contains(&rider)
                }
                Rider::Link { link, .. } => link == rider,
            })
        };
        let carries = |guide: LinkId| {
            links.len() > 1 && links.iter().any(|&rider| rider != guide && slides_on(rider, guide))
        };
        let named = links.iter().filter(|&&link| !carries(link));
        let mut numbers: Vec<u32> = named.map(|&link| mechanism.link(link).number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        self.reason_for(Cause::InLine(numbers))
    }

    /// A reason for what is drawn from something that is missing.
    pub(super) fn reason_missing(&mut self, what: Missing) -> Reason {
        self.reason_for(Cause::Missing(what))
    }

    fn reason_for(&mut self, why: Cause) -> Reason {
        let index = match self.reason_of.entry(why) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                self.reasons.push(new.key().clone());
                *new.insert(self.reasons.len() - 1)
            }
        };
        Reason::try_from(index).unwrap_or(Reason::MAX)
    }

    /// Why an answer behind this reason is not determined.
    pub(super) fn why(&self, reason: Reason) -> Indeterminate {
        match self.reasons.get(reason as usize) {
            Some(Cause::Missing(what)) => what.indeterminate(self.mechanism),
            Some(Cause::InLine(links)) => Indeterminate::DeadCentre { links: links.clone() },
            None => Indeterminate::DeadCentre { links: Vec::new() },
        }
    }

    /// The links behind every reason.
    pub(super) fn all_reasons(&self) -> Vec<Vec<u32>> {
        let links = |why: &Cause| match why {
            Cause::InLine(links) => links.clone(),
            Cause::Missing(Missing::Turning(link)) => vec![self.mechanism.link(*link).number],
            Cause::Missing(_) => Vec::new(),
        };
        self.reasons.iter().map(links).collect()
    }

    /// By reason how friction is stuck there, where it is that.
    pub(super) fn all_stuck(&self) -> Vec<Option<Stuck>> {
        let stuck = |why: &Cause| match why {
            Cause::Missing(Missing::Sense(_) | Missing::Side(_)) => Some(Stuck::AtRest),
            Cause::Missing(Missing::Balance) => Some(Stuck::Locked),
            _ => None,
        };
        self.reasons.iter().map(stuck).collect()
    }

    // --- the record ----------------------------------------------------------------------------

    /// Begins a numbered step.
    pub(super) fn step(&mut self, order: Order, links: &[LinkId], equations: Vec<Equation>) {
        if self.silent {
            return;
        }
        self.record.steps.push(Step {
            diagram: order.diagram(),
            links: links.to_vec(),
            equations,
            acts: Vec::new(),
        });
    }

    /// Begins the step of the rubbing speeds, unless the present one is it.
    pub(super) fn rubbing_step(&mut self) {
        let is_rub = |act: &Act| matches!(act, Act::Calculate(Calculation::Rub { .. }));
        if !self.record.steps.last().is_some_and(|step| step.acts.iter().any(is_rub)) {
            self.step(Order::Velocity, &[], Vec::new());
        }
    }

    /// Adds an equation to the present step.
    pub(super) fn equation(&mut self, equation: Equation) {
        if let (Some(step), false) = (self.record.steps.last_mut(), self.silent) {
            step.equations.push(equation);
        }
    }

    /// Records an act of the present step.
    pub(super) fn act(&mut self, act: Act) {
        if let (Some(step), false) = (self.record.steps.last_mut(), self.silent) {
            step.acts.push(act);
        }
    }

    /// Says once in the steps of a polygon that a link slides without turning.
    pub(super) fn tell_translation(&mut self, order: Order, link: LinkId) {
        if !self.silent && self.told_to_translate.insert((order, link)) {
            self.act(Act::Calculate(Calculation::Translation { link }));
        }
    }

    /// How many acts the present step has so far.
    pub(super) fn acts(&self) -> usize {
        self.record.steps.last().map_or(0, |step| step.acts.len())
    }

    /// Strikes the last act out.
    pub(super) fn take_back_act(&mut self) {
        if let (Some(step), false) = (self.record.steps.last_mut(), self.silent) {
            step.acts.pop();
        }
    }

    /// Whether an act has marked a contact point.
    pub(super) fn has_marked(&self, point: PointId) -> bool {
        let marks = |act: &Act| matches!(act, Act::MarkContact { contact } if *contact == point);
        self.record.steps.iter().any(|step| step.acts.iter().any(marks))
    }

    pub(super) fn step_index(&self) -> usize {
        self.record.steps.len().saturating_sub(1)
    }

    /// Notes a place of the skeleton.
    pub(super) fn place(&mut self, point: PointId, at: Point) {
        self.places[point.0] = Some(at);
        self.record.space.places[point.0] = Some(at.value());
    }

    /// Notes a line of the skeleton's construction.
    pub(super) fn space_line(&mut self, line: ConstructionLine) {
        if self.silent {
            return;
        }
        self.record.space.lines.push(line);
    }

    /// Opens the circle diagram.
    pub(super) fn note_circle(&mut self, diagram: CircleDiagram) {
        self.record.circle = Some(diagram);
    }

    /// Notes a centre of the circle diagram.
    pub(super) fn note_centre(&mut self, centre: Centre) {
        if let Some(circle) = &mut self.record.circle {
            circle.centres.push(centre);
        }
    }

    /// Notes the centres at which the circle diagram stalls.
    pub(super) fn note_stalled(&mut self, stalled: Vec<[LinkId; 2]>) {
        if let Some(circle) = &mut self.record.circle {
            circle.still =
                stalled.iter().copied().filter(|links| self.centres.still.contains(links)).collect();
            circle.stalled = stalled;
        }
    }

    /// Opens a construction on the skeleton.
    pub(super) fn open_auxiliary(&mut self, kind: Auxiliary) {
        self.record.auxiliary.push(AuxiliaryDrawing {
            kind,
            strokes: Vec::new(),
            points: Vec::new(),
            acts: Vec::new(),
            refused: None,
        });
    }

    /// Notes a stroke of the construction on the skeleton that is being drawn.
    pub(super) fn note_stroke(&mut self, stroke: Stroke) {
        if let Some(drawing) = self.record.auxiliary.last_mut() {
            drawing.strokes.push(stroke);
        }
    }

    /// Notes the chord between two meeting points.
    pub(super) fn note_chord(&mut self, [from, to]: [[f64; 2]; 2]) {
        let shape = StrokeShape::Line(from, to);
        self.note_stroke(Stroke { shape, role: StrokeRole::Produced, claim: None });
    }

    /// Notes a named point of the construction on the skeleton that is being drawn.
    pub(super) fn note_named(&mut self, point: NamedPoint) {
        if let Some(drawing) = self.record.auxiliary.last_mut() {
            drawing.points.push(point);
        }
    }

    /// Records an act of the construction on the skeleton that is being drawn.
    pub(super) fn act_auxiliary(&mut self, act: AuxiliaryAct) {
        if let Some(drawing) = self.record.auxiliary.last_mut() {
            drawing.acts.push(act);
        }
    }

    /// Notes why the construction on the skeleton that is being drawn does not exist here.
    pub(super) fn refuse_auxiliary(&mut self, why: &'static str) {
        if let Some(drawing) = self.record.auxiliary.last_mut() {
            drawing.refused = Some(why);
        }
    }

    /// The transfers of velocities by centres.
    pub(super) fn transfers_mut(&mut self) -> Option<&mut Vec<Transfer>> {
        self.record.circle.as_mut().map(|circle| &mut circle.transfers)
    }

    /// The transfer that is being drawn.
    pub(super) fn transfer_mut(&mut self) -> Option<&mut Transfer> {
        self.transfers_mut()?.last_mut()
    }

    /// Opens a polygon.
    pub(super) fn open_polygon(&mut self, order: Order) {
        self.record.diagrams.push(Diagram {
            kind: order.diagram(),
            si_per_mm: self.polygon_scale(order).si_per_mm,
            images: Vec::new(),
            vectors: Vec::new(),
            lines: Vec::new(),
            link_images: Vec::new(),
        });
    }

    pub(super) fn polygon(&self, order: Order) -> Option<&Diagram> {
        self.record.diagram(order.diagram())
    }

    /// The polygon to draw in; none while a trial is on the board.
    fn polygon_mut(&mut self, order: Order) -> Option<&mut Diagram> {
        if self.silent {
            return None;
        }
        self.record.diagrams.iter_mut().find(|diagram| diagram.kind == order.diagram())
    }

    /// The images of a polygon, by point; those of fixed points are the pole.
    pub(super) fn images(&mut self, order: Order) -> &mut Images {
        &mut self.motion_mut(order).images
    }

    /// What is known of the motion at this order: of velocities, or of accelerations.
    pub(super) fn motion(&self, order: Order) -> &Motion {
        &self.motions[usize::from(order == Order::Acceleration)]
    }

    pub(super) fn motion_mut(&mut self, order: Order) -> &mut Motion {
        &mut self.motions[usize::from(order == Order::Acceleration)]
    }

    /// The image of a point whose image is known; the pole for a fixed one. What depends on an image that no
    /// step has drawn is refused.
    pub(super) fn image(&mut self, order: Order, point: PointId) -> Point {
        let known = self.images(order)[point.0];
        match known {
            Some(image) => image,
            None if self.mechanism.is_fixed(point) => self.board.origin(),
            None => self.no_point(Missing::Image(order, point)),
        }
    }

    /// The contact point of a rolling pair.
    pub(super) fn contact_of(&self, roll: usize) -> PointId {
        self.mechanism.contacts[roll]
    }

    /// The label of a point's image; the link's number is told where other links have points under it.
    pub(super) fn label(&self, point: PointId) -> Label {
        if self.mechanism.is_fixed(point) {
            return Label::Pole;
        }
        let link = if self.has_under[point.0] { home(self.mechanism, self.structure, point) } else { None };
        Label::Image { point, link }
    }

    /// The label of the point of a link under a pin of another.
    pub(super) fn label_under(&self, pin: PointId, link: LinkId) -> Label {
        match link {
            LinkId::FRAME => Label::Pole,
            _ if self.mechanism.link(link).points.contains(&pin) => self.label(pin),
            _ => Label::Image { point: pin, link: Some(link) },
        }
    }

    /// Notes a vector that answers a quantity, for reading.
    pub(super) fn note_part(&mut self, quantity: Quantity, tail: Point, head: Point) {
        self.parts.push(Part { quantity, tail, head });
    }

    /// Notes the image of the point of a link under a pin, and tells where it stands.
    pub(super) fn note_under(&mut self, order: Order, pin: PointId, link: LinkId, image: Point) -> Point {
        let image = self.under_as_drawn(order, pin, link, image);
        self.coincident.push(Coincident { order, pin, link, image });
        let label = self.label_under(pin, link);
        self.note_foot(order, label, image);
        let pole = self.board.origin();
        let quantity = match order {
            Order::Acceleration => Quantity::CoincidentAcceleration(pin, link),
            _ => Quantity::CoincidentVelocity(pin, link),
        };
        self.note_part(quantity, pole, image);
        image
    }

    /// Notes the image of a point, and tells where it stands.
    pub(super) fn note_image(&mut self, order: Order, point: PointId, at: Point) -> Point {
        let at = self.image_as_drawn(order, point, at);
        self.images(order)[point.0] = Some(at);
        let image = Image { label: self.label(point), at: at.value() };
        if let Some(polygon) = self.polygon_mut(order) {
            polygon.images.push(image);
        }
        at
    }

    /// Notes the end of a component.
    pub(super) fn note_foot(&mut self, order: Order, label: Label, at: Point) {
        if let Some(polygon) = self.polygon_mut(order) {
            polygon.images.push(Image { label, at: at.value() });
        }
    }

    /// Notes the image of a whole link.
    pub(super) fn note_link_image(&mut self, order: Order, link: LinkId) {
        let points = self.mechanism.link(link).points.clone();
        if points.len() < 3 {
            return;
        }
        let mut corners = Vec::new();
        for point in points {
            if self.mechanism.is_fixed(point) || self.images(order)[point.0].is_some() {
                corners.push((point, self.image(order, point).value()));
            }
        }
        if corners.len() > 2
            && let Some(polygon) = self.polygon_mut(order)
        {
            // A link of a group of higher class is drawn by a group inside it before the whole is noted.
            polygon.link_images.retain(|image| image.link != link);
            polygon.link_images.push(LinkImage { link, corners });
        }
    }

    /// Whether a vector may lead from the pole to this image: where none does so, never.
    pub(super) fn leads_from_pole(&self, order: Order, head: Label) -> bool {
        self.from_pole.contains(&(order, head))
    }

    /// Notes a vector of a polygon and returns its index.
    pub(super) fn note_vector(
        &mut self,
        order: Order,
        (kind, quantity, claim): (VectorKind, Quantity, Option<Claim>),
        (tail, from): (Label, Point),
        (head, to): (Label, Point),
    ) -> usize {
        let step = self.step_index();
        let (from, to) = (from.value(), to.value());
        let as_point = is_a_point(libm::hypot(to[0] - from[0], to[1] - from[1]));
        if tail == Label::Pole && self.polygon(order).is_some() {
            self.from_pole.insert((order, head));
        }
        let Some(polygon) = self.polygon_mut(order) else { return 0 };
        polygon.vectors.push(Vector {
            kind,
            quantity,
            tail,
            head,
            from,
            to,
            claim,
            as_point,
            is_zero: false,
            step,
        });
        polygon.vectors.len() - 1
    }

    /// Notes a construction line of a polygon.
    pub(super) fn note_ray(&mut self, order: Order, from: Point, to: Point, claim: Claim) {
        let step = self.step_index();
        let ray = ConstructionLine::Ray { from: from.value(), to: to.value(), claim: Some(claim), step };
        if let Some(polygon) = self.polygon_mut(order) {
            polygon.lines.push(ray);
        }
    }

    /// Notes the line on which an image lies whatever rate is tried.
    pub(super) fn note_trial_line(&mut self, order: Order, from: Point, to: Point) {
        let step = self.step_index();
        let ray = ConstructionLine::Ray { from: from.value(), to: to.value(), claim: None, step };
        if let Some(polygon) = self.polygon_mut(order) {
            polygon.lines.push(ray);
        }
    }

    /// The side that a trial prescribes for the next choice.
    pub(super) fn prescribed_side(&mut self) -> Option<Side> {
        let sides = self.sides.as_mut()?;
        if sides.is_empty() { None } else { Some(sides.remove(0)) }
    }

    /// Notes which of the possible places was taken.
    pub(super) fn chosen(&mut self, which: usize) {
        if !self.silent {
            self.record.space.choices.push(which);
        }
    }

    /// Reads a vector off its polygon, for the step list.
    pub(super) fn act_read(&mut self, order: Order, vector: usize) {
        if self.silent {
            return;
        }
        let scale = self.polygon_scale(order).si_per_mm;
        let Some(v) = self.polygon(order).and_then(|p| p.vectors.get(vector)) else { return };
        let mm = libm::hypot(v.to[0] - v.from[0], v.to[1] - v.from[1]);
        self.act(Act::ReadVector { vector, mm, value: mm * scale });
    }
}

/// Which points are on moving guides or roll on moving links, so that points of other links lie under them; by point.
fn with_points_under(mechanism: &Mechanism, structure: &Structure) -> Vec<bool> {
    let moving = |slide: usize| mechanism.slides[slide].guide.link != LinkId::FRAME;
    let mut all = vec![false; mechanism.points.len()];
    for slide in &mechanism.slides {
        if let Rider::Pin { point, .. } = slide.rider {
            all[point.0] |= slide.guide.link != LinkId::FRAME;
        }
    }
    for (target, unknowns) in structure.groups.iter().filter_map(|group| group.kind.unknowns(mechanism)) {
        for unknown in unknowns {
            match (unknown, target) {
                (Unknown::Slide { slide, .. }, Target::Pin(pin))
                | (Unknown::Carried { hold: Hold::Slide(slide), pin, .. }, _) => {
                    all[pin.0] |= moving(slide);
                }
                (Unknown::Roll { centre, back: true, .. }, _) => all[centre.0] = true,
                _ => {}
            }
        }
    }
    all
}
