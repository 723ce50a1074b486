//! Friction: forces that lean by the angle of friction in guides and touch friction circles at pins.
//!
//! Senses come from the motion alone. Where on its circle a force acts, and to which side of the normal it leans, hangs
//! on where it points: the forces are drawn without friction first, and again with the points of contact and the leans of
//! the forces drawn before, until none of them moves by more than the drawing can tell. With its point of contact each
//! force of a pin is one that passes through a known point, so that every group is balanced as without friction.

use std::collections::BTreeMap;

use crate::board::{Amount, Arithmetic, Board, Direction, Point, Scale};
use crate::given::Given;
use crate::mechanism::force::{Party, Share};
use crate::mechanism::friction::{FrictionCircle, Resistance, Roughness, Rub, RubbedBy, RubbingPair};
use crate::mechanism::quantity::{Order, Stuck};
use crate::mechanism::structure::Structure;
use crate::mechanism::{LinkId, Mechanism, PointId};
use crate::plan::Plan;

use super::super::draughtsman::Draughtsman;
use super::super::missing::Missing;
use super::{Balance, Holder, Item, Pull};

/// After so many passes the forces come to no end.
const MOST_PASSES: usize = 60;

/// Before the last pass, a force below this part of the largest one has no direction to go by, if it does not stand clear
/// of its error.
const FAINT: f64 = 1e-9;

/// One that was above it, and by which a force leans already, keeps its direction down to this part of that: a lean may
/// move a force across.
const KEPT: f64 = 1e-3;

/// A drawing that is run for other places has so many passes more than its own place needs, and there counts as settled
/// only where the last of them turns no force by more than `TURNED`, radians. Where its own place comes to no end other
/// places may: it then has all passes.
const MORE_PASSES: usize = 2;
const TURNED: f64 = 1e-6;

/// So often the part of the stated friction is halved at which it locks.
const HALVINGS: usize = 40;

/// A balance that comes to no end even with this part of its friction fails for another reason.
const HARDLY: f64 = 1e-6;

/// The longer leg by which an angle of friction is drawn is 64 mm, long enough for a hand: one over that.
const LEG: f64 = 1.0 / 64.0;

/// Where circles grow from nothing, they have their size after so many passes.
const GROWING: usize = 24;

/// Two balances are one where no force of a rubbing pair differs by more than this part of the largest.
const ONE: f64 = 1e-5;

/// How passes on scratch paper begin that look for another balance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(in super::super) enum Begun {
    /// With circles of their size, from forces without friction.
    #[default]
    Plainly,
    /// With points for circles, which grow pass by pass: forces lean by their guides first, and then find their circles.
    WithPoints,
    /// With circles of their size, which forces touch first on the side where they would with the opposite sense: circles
    /// that reach past the arms of their forces have a balance there.
    TurnedRound,
}

/// Other sides are tried of so many guides at most.
const MOST_GUIDES: usize = 6;

/// What rubs in a drawing.
#[derive(Debug, Clone)]
pub(super) enum Rubbed {
    /// At a pin; the radius of the circle in the sense in which the link turns on its carrier, metres.
    Pin { pin: PointId, carrier: LinkId, link: LinkId, radius: Amount },
    /// In a sliding pair: the direction of the guide and the normal, tan φ in the sense of the sliding, and the constant
    /// force on the rider.
    Slide { slide: usize, along: Direction, normal: Direction, tangent: Option<Amount>, drag: Option<Pull> },
}

impl Rubbed {
    fn pair(&self) -> RubbingPair {
        match self {
            Self::Pin { pin, carrier, link, .. } => {
                RubbingPair::Pin { pin: *pin, carrier: *carrier, link: *link }
            }
            Self::Slide { slide, .. } => RubbingPair::Slide(*slide),
        }
    }
}

/// Where forces touch their circles in a pass, and how they lean.
#[derive(Debug, Clone, Default)]
pub(super) struct Leaning {
    /// Where the force between a pin and a link acts; elsewhere it acts at the pin.
    contacts: BTreeMap<(usize, usize), Point>,
    /// The line of a guide's force; elsewhere it is the normal.
    leans: BTreeMap<usize, Direction>,
    /// Constant forces on riders, by sliding pair.
    drags: BTreeMap<usize, Pull>,
    /// How often the forces were drawn again.
    passes: usize,
    /// How teeth drive: the force along the tangent on the second body, newtons; by rolling pair. None where nothing
    /// drives.
    flanks: BTreeMap<usize, Amount>,
    /// What rubs, for the record.
    rubs: Vec<Rub>,
    /// What the pass went by, by the place of the pair.
    seen: BTreeMap<usize, Seen>,
    /// How hard rough guides press, and on which side, as parts of the largest force; by sliding pair.
    pressing: BTreeMap<usize, f64>,
    /// The passes came to no end.
    endless: bool,
}

/// What a pass goes by.
#[derive(Debug, Clone, Copy)]
enum Seen {
    /// Where the force of a pin points.
    Toward(Direction),
    /// How hard, and on which side, a guide presses.
    Pressing(Amount),
}

impl Leaning {
    pub(super) fn passes(&self) -> usize {
        self.passes
    }

    pub(super) fn rubs(&self) -> &[Rub] {
        &self.rubs
    }

    /// Whether the force of a guide leans.
    pub(super) fn leans(&self, slide: usize) -> bool {
        self.leans.contains_key(&slide)
    }

    /// In which sense the teeth of a rolling pair drove the second body when the forces were drawn before.
    pub(super) fn flank(&self, roll: usize) -> Option<Amount> {
        self.flanks.get(&roll).copied()
    }

    pub(super) fn drag(&self, slide: usize) -> Option<Pull> {
        self.drags.get(&slide).copied()
    }
}

/// What a pass looks at to see whether forces have moved: direction and size of the force of each pair.
struct Look {
    /// None where no polygon leads to it.
    forces: Vec<Option<[f64; 2]>>,
    largest: f64,
}

impl Look {
    /// How far the force of each pair has turned since, radians; a whole turn round where a guide presses on its other
    /// side.
    fn turned_since(&self, before: &Self) -> Vec<f64> {
        let pairs = self.forces.iter().zip(&before.forces);
        pairs
            .map(|(now, then)| {
                let (Some(now), Some(then)) = (now, then) else { return 0.0 };
                // What was too faint to go by has just begun to lean.
                if before.is_faint(*then) && !self.is_faint(*now) {
                    return std::f64::consts::PI;
                }
                let (cross, dot) = (then[0] * now[1] - then[1] * now[0], then[0] * now[0] + then[1] * now[1]);
                libm::atan2(cross, dot).abs()
            })
            .collect()
    }

    /// Whether a force has no direction to go by.
    fn is_faint(&self, [x, y]: [f64; 2]) -> bool {
        libm::hypot(x, y) <= FAINT * self.largest
    }

    /// Whether a force that had a direction in the pass before has none any more.
    fn has_faded(&self, [x, y]: [f64; 2]) -> bool {
        libm::hypot(x, y) <= KEPT * FAINT * self.largest
    }

    /// The largest turn of a force that counts: what a turn does to a moment is of second order in it and of first in
    /// the force.
    fn moved(&self, turns: &[f64]) -> f64 {
        let weight = |force: &[f64; 2]| libm::sqrt(libm::hypot(force[0], force[1]) / self.largest);
        let counted = self.forces.iter().zip(turns);
        let counted = counted.filter_map(|(force, turn)| Some(weight(force.as_ref()?) * turn));
        if self.largest == 0.0 { 0.0 } else { counted.fold(0.0, f64::max) }
    }
}

/// The balance of a mechanism in which pairs rub.
pub(super) fn balance(d: &mut Draughtsman<'_>, plan: &Plan, share: Share) -> Balance {
    let refused = |why: &'static str| Balance { refused: Some(why), ..Balance::default() };
    if !d.rubbing_pins_are_held() {
        return refused(
            "this version does not draw friction at a pin of several links that is carried by a link which is found later",
        );
    }
    if d.mechanism.forces.spin.is_some_and(|spin| spin.imagined && share == Share::Total) {
        return refused(super::spin::RESTS);
    }
    let (rubbed, senses) = d.rubbed(plan, share);
    let mut leaning = Leaning::default();
    for rub in &rubbed {
        if let Rubbed::Slide { slide, drag: Some(drag), .. } = rub {
            leaning.drags.insert(*slide, *drag);
        }
    }
    let mut resting: Vec<RubbingPair> = Vec::new();
    for (pair, sense) in senses {
        if d.board.is_weak(sense) {
            resting.push(pair);
        }
    }
    // Nobody knows the friction of a pair that does not move: what hangs on it leads nowhere.
    let (rests, mut rubbed): (Vec<Rubbed>, Vec<Rubbed>) =
        rubbed.into_iter().partition(|rub| resting.contains(&rub.pair()));
    for (rub, pair) in rests.iter().map(|rub| (rub, rub.pair())) {
        leaning = d.nowhere(std::slice::from_ref(rub), leaning, Missing::Sense(pair));
    }
    let fresh = leaning.clone();
    let circles = rubbed.clone();
    if rubbed.is_empty() {
        return super::whole(d, plan, share, &leaning);
    }
    let mut balance = super::whole(d, plan, share, &leaning);
    let settled = match d.board.tape().arithmetic() {
        Arithmetic::Single => libm::sqrt(f64::from(f32::EPSILON)),
        Arithmetic::Double => libm::sqrt(f64::EPSILON),
        // As well as a look, in doubles, can tell.
        Arithmetic::DoubleDouble | Arithmetic::Wide => 64.0 * f64::EPSILON,
    };
    let mut before: Option<Look> = None;
    let runs = d.board.tape().will_be_run();
    let told = d.redrawn.iter().find(|(of, _)| *of == share).map(|(_, passes)| *passes);
    let mut more = if runs { MORE_PASSES } else { 0 };
    for pass in 1..=MOST_PASSES {
        if balance.refused.is_some() {
            return balance;
        }
        let look = d.look_at(&balance, &rubbed);
        let turns = before.as_ref().map(|before| look.turned_since(before));
        let is_settled = turns.as_ref().is_some_and(|turns| look.moved(turns) <= settled);
        let grown = d.begun != Begun::WithPoints || pass > GROWING;
        let is_settled = is_settled && grown;
        let last = match told {
            Some(passes) => pass == passes,
            None => (is_settled && more == 0) || (runs && pass == MOST_PASSES),
        };
        more -= usize::from(is_settled && more > 0);
        let gone_by = std::mem::take(&mut leaning.seen);
        leaning = Leaning { passes: pass, ..fresh.clone() };
        d.swell(&mut rubbed, &circles, pass);
        d.lean(&mut leaning, &balance, &rubbed, (&look, turns.as_deref().filter(|_| last)), &gone_by);
        balance = super::whole(d, plan, share, &leaning);
        if last {
            return balance;
        }
        before = Some(look);
    }
    leaning = d.nowhere(&rubbed, Leaning { endless: true, ..fresh }, Missing::Balance);
    super::whole(d, plan, share, &leaning)
}

impl Draughtsman<'_> {
    /// The circles of a pass, where they are not those of the scene from the beginning on.
    fn swell(&mut self, rubbed: &mut [Rubbed], circles: &[Rubbed], pass: usize) {
        let part = match self.begun {
            Begun::Plainly => return,
            Begun::WithPoints if pass <= GROWING => (pass - 1) as f64 / GROWING as f64,
            Begun::TurnedRound if pass == 1 => -1.0,
            Begun::WithPoints | Begun::TurnedRound => 1.0,
        };
        for (rub, of) in rubbed.iter_mut().zip(circles) {
            if let (Rubbed::Pin { radius, .. }, Rubbed::Pin { radius: whole, .. }) = (rub, of) {
                let part = self.board.amount(Given::exact(part));
                *radius = self.board.product(*whole, part);
            }
        }
    }

    /// Every pin of several links at which something rubs is held by its carrier.
    fn rubbing_pins_are_held(&self) -> bool {
        let m = self.mechanism;
        m.forces.friction.pins.iter().all(|rubbing| {
            let carrier = m.rubbing_carrier(rubbing.pin).map(Holder::Link);
            m.parties_at(rubbing.pin).len() == 2 || carrier == Some(self.holder(rubbing.pin))
        })
    }

    /// Whatever hangs on friction has no place.
    fn nowhere(&mut self, rubbed: &[Rubbed], mut leaning: Leaning, why: Missing) -> Leaning {
        let reason = self.reason_missing(why);
        for rub in rubbed {
            match rub {
                Rubbed::Pin { pin, link, .. } => {
                    let nowhere = self.board.nowhere(reason);
                    self.touch(&mut leaning, *pin, *link, nowhere);
                }
                Rubbed::Slide { slide, tangent: Some(_), .. } => {
                    let nowhere = self.board.no_direction(reason);
                    leaning.leans.insert(*slide, nowhere);
                }
                Rubbed::Slide { .. } => {}
            }
        }
        leaning
    }

    /// What rubs on the links of a plan, in the senses of the motion; and for each pair something that has its sense.
    fn rubbed(&mut self, plan: &Plan, share: Share) -> (Vec<Rubbed>, Vec<(RubbingPair, Amount)>) {
        let m = self.mechanism;
        let about_to = self.about_to_move(share);
        let (mut all, mut senses) = (Vec::new(), Vec::new());
        for pair in m.rubbing_pairs() {
            if !m.rubbing_links(pair).iter().any(|link| plan.forces.links.contains(link)) {
                continue;
            }
            let reason = self.reason_missing(Missing::Sense(pair));
            match pair {
                RubbingPair::Pin { pin, carrier, link } => {
                    let Some(circle) = m.forces.friction.circle(pin) else { continue };
                    let turning = self.rate(Order::Velocity, link);
                    let carried = self.rate(Order::Velocity, carrier);
                    let turning = self.board.difference(turning, carried);
                    let turning = self.in_sense_of_sleeve(turning, about_to);
                    let radius = match circle {
                        FrictionCircle::Radius(radius) => self.board.amount(radius),
                        FrictionCircle::Journal { radius, roughness } => {
                            let radius = self.board.amount(radius);
                            let leg = self.leaning_leg(roughness);
                            let [_, across] = self.board.components(leg, radius);
                            across
                        }
                    };
                    let radius = self.board.in_sense_of(radius, turning, reason);
                    let radius = self.circle_as_drawn(pin, radius);
                    senses.push((pair, radius));
                    all.push(Rubbed::Pin { pin, carrier, link, radius });
                }
                RubbingPair::Slide(slide) => {
                    let (Some(resistance), Some(point)) =
                        (m.forces.friction.resistance(slide), m.pin_of_slide(slide))
                    else {
                        continue;
                    };
                    let at = self.at(point);
                    let (along, normal) = self.guide_at(slide, at);
                    let sliding = self.sliding_along(slide, point, along);
                    let sliding = self.in_sense_of_sleeve(sliding, about_to);
                    let tangent = resistance.roughness().map(|roughness| {
                        let tangent = match roughness {
                            Roughness::Coefficient(f) => self.board.amount(f),
                            Roughness::Angle(_) => {
                                let leg = self.leaning_leg(roughness);
                                let unit = self.board.amount(Given::exact(1.0));
                                let [along, across] = self.board.components(leg, unit);
                                self.board.quotient(across, along, reason)
                            }
                        };
                        let tangent = self.board.in_sense_of(tangent, sliding, reason);
                        let tangent = self.leaning_as_drawn(slide, tangent);
                        senses.push((pair, tangent));
                        tangent
                    });
                    let drag = resistance.drag().map(|drag| {
                        let drag = self.board.amount(drag);
                        let with = self.board.in_sense_of(drag, sliding, reason);
                        senses.push((pair, with));
                        let against = self.board.opposite(with);
                        self.pull_along(along, against)
                    });
                    all.push(Rubbed::Slide { slide, along, normal, tangent, drag });
                }
            }
        }
        (all, senses)
    }

    /// How the sleeve of a governor that is about to move would slide, as the drawn motion has it, turned round where it is
    /// about to move back; none of other mechanisms, whose senses are those of their motion.
    fn about_to_move(&mut self, share: Share) -> Option<Amount> {
        if !matches!(share, Share::Rising | Share::Falling) {
            return None;
        }
        let slide = self.mechanism.sleeve_slide()?;
        let point = self.mechanism.pin_of_slide(slide)?;
        let at = self.at(point);
        let (along, _) = self.guide_at(slide, at);
        let sliding = self.sliding_along(slide, point, along);
        Some(if share == Share::Rising { sliding } else { self.board.opposite(sliding) })
    }

    /// A rate of the drawn motion in the sense in which the sleeve is about to move.
    fn in_sense_of_sleeve(&mut self, rate: Amount, about_to: Option<Amount>) -> Amount {
        match about_to {
            Some(sleeve) => self.board.product(rate, sleeve),
            None => rate,
        }
    }

    /// The direction that makes the angle of friction with +x: the hypotenuse over 1 and f, or by protractor.
    fn leaning_leg(&mut self, roughness: Roughness) -> Direction {
        match roughness {
            Roughness::Angle(angle) => {
                let angle = self.board.angle(angle);
                self.board.protractor(angle)
            }
            Roughness::Coefficient(f) => {
                let pole = self.board.origin();
                let right = self.board.rightward();
                let up = self.board.quarter_turn(right);
                let scale = Scale { si_per_mm: LEG };
                let legs = [Given::exact(1.0), f].map(|leg| {
                    let leg = self.board.amount(leg);
                    self.board.to_paper(leg, scale)
                });
                let foot = self.board.lay_off(pole, right, legs[0]);
                let tip = self.board.lay_off(foot, up, legs[1]);
                let reason = self.reason(&[]);
                self.board.toward(pole, tip, reason).0
            }
        }
    }

    /// How fast a rider moves along its guide, by the images of its point and of the guide's point under it.
    fn sliding_along(&mut self, slide: usize, point: PointId, along: Direction) -> Amount {
        let guide = self.mechanism.slides[slide].guide.link;
        let under = self.image_under(Order::Velocity, point, guide);
        let image = self.image(Order::Velocity, point);
        let scale = self.polygon_scale(Order::Velocity);
        let parts = self.board.between(under, image).map(|part| self.board.read(part, scale));
        self.part_along(parts, along)
    }

    /// The part of a vector along a direction.
    pub(super) fn part_along(&mut self, [x, y]: [Amount; 2], along: Direction) -> Amount {
        let unit = self.board.amount(Given::exact(1.0));
        let [ax, ay] = self.board.components(along, unit);
        let (px, py) = (self.board.product(x, ax), self.board.product(y, ay));
        self.board.sum(px, py)
    }

    /// The force of a pair, as it was drawn last.
    fn force_of(&self, balance: &Balance, rubbed: &Rubbed) -> Option<Pull> {
        match rubbed {
            Rubbed::Slide { slide, .. } => balance.slides.get(slide).map(|force| force.pull),
            Rubbed::Pin { pin, carrier, link, .. } => {
                let of = |link: LinkId| balance.of_pins.get(&(pin.0, link.0)).copied();
                let two = self.mechanism.parties_at(*pin).len() == 2;
                of(*link).or(if two { of(*carrier).map(Self::opposite) } else { None })
            }
        }
    }

    /// Looks at the forces of what rubs; a guide is looked at along its normal.
    fn look_at(&self, balance: &Balance, rubbed: &[Rubbed]) -> Look {
        let vector = |pull: Pull| {
            let ([x, y], [from_x, from_y]) = (pull.head.value(), pull.tail.value());
            [x - from_x, y - from_y]
        };
        let all = balance.of_pins.values().copied().chain(balance.slides.values().map(|force| force.pull));
        let largest = all.map(vector).fold(0.0_f64, |most, [x, y]| most.max(libm::hypot(x, y)));
        let forces = rubbed.iter().map(|rub| {
            let [x, y] = vector(self.force_of(balance, rub)?);
            Some(match rub {
                Rubbed::Pin { .. } => [x, y],
                Rubbed::Slide { normal, .. } => {
                    let [nx, ny] = normal.value();
                    [x * nx + y * ny, 0.0]
                }
            })
        });
        Look { forces: forces.collect(), largest }
    }

    /// Finds points of contact and leans by the forces drawn before. In the last pass the circles have the room that
    /// further passes would take: a line through a point of contact that has turned by δ passes its pin at r cos δ.
    fn lean(
        &mut self,
        leaning: &mut Leaning,
        balance: &Balance,
        rubbed: &[Rubbed],
        (look, turns): (&Look, Option<&[f64]>),
        gone_by: &BTreeMap<usize, Seen>,
    ) {
        self.note_flanks(leaning, balance, look.largest);
        let guards = turns.is_some() && self.board.tape().will_be_run();
        for (index, rub) in rubbed.iter().enumerate() {
            let Some([x, y]) = look.forces[index] else { continue };
            let leaned = gone_by.contains_key(&index);
            let faint = if leaned { look.has_faded([x, y]) } else { look.is_faint([x, y]) };
            let Some(pull) = self.force_of(balance, rub) else { continue };
            let faint = faint && !self.is_seen(pull);
            if (x == 0.0 && y == 0.0) || (turns.is_none() && faint) {
                continue;
            }
            // A drawing of this one place: there what is no more than rounding rubs no more than that.
            if faint && !self.board.tape().will_be_run() {
                self.rub_faintly(leaning, rub);
                continue;
            }
            match rub {
                Rubbed::Pin { pin, carrier, link, radius } => {
                    let mut turn = match turns {
                        Some(turns) => turns[index],
                        // Before the last pass nothing is left to be done by further ones.
                        None => 0.0,
                    };
                    let reason = self.reason(&[*carrier, *link]);
                    let (along, _) = self.board.toward(pull.tail, pull.head, reason);
                    let mut radius = *radius;
                    if let (true, Some(Seen::Toward(then))) = (guards, gone_by.get(&index)) {
                        radius = self.unturned(radius, *then, along);
                        turn = 0.0;
                    }
                    leaning.seen.insert(index, Seen::Toward(along));
                    if turn != 0.0 {
                        let room = self.board.amount(Given::within(1.0, (0.5 * turn * turn).min(2.0)));
                        radius = self.board.product(radius, room);
                    }
                    let left = self.board.quarter_turn(along);
                    let scale = self.length_scale();
                    let mm = self.board.to_paper(radius, scale);
                    let centre = self.at(*pin);
                    // A force to the left of the pin turns cw about it: against a link that turns ccw.
                    let contact = self.board.step_off(centre, left, mm);
                    self.touch(leaning, *pin, *link, contact);
                    let by = RubbedBy::Circle(radius.value().abs());
                    let pair = RubbingPair::Pin { pin: *pin, carrier: *carrier, link: *link };
                    leaning.rubs.push(Rub { pair, by, forward: radius.value() > 0.0 });
                }
                Rubbed::Slide { slide, along, normal, tangent, drag } => {
                    let pair = RubbingPair::Slide(*slide);
                    if let Some(drag) = drag {
                        self.note_drag(leaning, pair, (*drag, *along));
                    }
                    let Some(tangent) = *tangent else { continue };
                    let parts = self.components_of(pull);
                    let pressing = self.part_along(parts, *normal);
                    let mut tangent = tangent;
                    if let (true, Some(Seen::Pressing(then))) = (guards, gone_by.get(&index)) {
                        let same = self.board.product(pressing, *then);
                        tangent = self.only_where(tangent, same);
                    }
                    leaning.seen.insert(index, Seen::Pressing(pressing));
                    leaning.pressing.insert(*slide, x / look.largest);
                    let side = self.pressed.iter().find(|(pair, _)| pair == slide).map(|(_, left)| *left);
                    let sense = match side {
                        Some(true) => tangent,
                        Some(false) => self.board.opposite(tangent),
                        None => {
                            let reason = self.reason_missing(Missing::Side(pair));
                            self.board.in_sense_of(tangent, pressing, reason)
                        }
                    };
                    self.lean_by(leaning, *slide, (*along, *normal), sense);
                    let by = RubbedBy::Angle(libm::atan(tangent.value().abs()));
                    leaning.rubs.push(Rub { pair, by, forward: tangent.value() > 0.0 });
                }
            }
        }
    }

    /// Whether a force has a direction however faint it is beside others: it stands clear of its error.
    fn is_seen(&mut self, pull: Pull) -> bool {
        self.components_of(pull).into_iter().any(|part| self.board.stands_clear(part))
    }

    /// Notes by which flank teeth drive. Where something is sought by trials a trial must lean as the whole will: what
    /// teeth push apart is in proportion to what they drive only on one flank.
    fn note_flanks(&mut self, leaning: &mut Leaning, balance: &Balance, largest: f64) {
        if balance.assumed.is_empty() {
            return;
        }
        for roll in balance.rolls.keys().copied().collect::<Vec<usize>>() {
            if !self.leans_by_teeth(roll) {
                continue;
            }
            let parts = self.components_of(balance.rolls[&roll].pull);
            let contact = self.contact_at(roll);
            let along = self.part_along(parts, contact.tangent);
            if along.value().abs() > FAINT * largest * self.force_scale().si_per_mm {
                leaning.flanks.insert(roll, along);
            }
        }
    }

    /// A force that is none but for rounding has no direction, and touches its circle, or leans, nobody knows where: at the
    /// middle, within as much as it may be off.
    fn rub_faintly(&mut self, leaning: &mut Leaning, rub: &Rubbed) {
        let either = self.board.amount(Given::within(0.0, 1.0));
        match rub {
            Rubbed::Pin { pin, carrier, link, radius } => {
                let scale = self.length_scale();
                let off = self.board.product(*radius, either);
                let mm = self.board.to_paper(off, scale);
                let right = self.board.rightward();
                let up = self.board.quarter_turn(right);
                let centre = self.at(*pin);
                let beside = self.board.step_off(centre, right, mm);
                let contact = self.board.step_off(beside, up, mm);
                self.touch(leaning, *pin, *link, contact);
                let by = RubbedBy::Circle(radius.value().abs());
                let pair = RubbingPair::Pin { pin: *pin, carrier: *carrier, link: *link };
                leaning.rubs.push(Rub { pair, by, forward: radius.value() > 0.0 });
            }
            Rubbed::Slide { slide, along, normal, tangent, drag } => {
                let pair = RubbingPair::Slide(*slide);
                if let Some(drag) = drag {
                    self.note_drag(leaning, pair, (*drag, *along));
                }
                if let Some(tangent) = *tangent {
                    let off = self.board.product(tangent, either);
                    self.lean_by(leaning, *slide, (*along, *normal), off);
                    let by = RubbedBy::Angle(libm::atan(tangent.value().abs()));
                    leaning.rubs.push(Rub { pair, by, forward: tangent.value() > 0.0 });
                }
            }
        }
    }

    /// Notes a constant force against sliding.
    fn note_drag(&mut self, leaning: &mut Leaning, pair: RubbingPair, (drag, along): (Pull, Direction)) {
        let [x, y] = self.components_of(drag).map(|part| part.value());
        let [ax, ay] = along.value();
        // Of a governor a half is drawn, and the whole is told.
        let halves = self.mechanism.forces.spin.map_or(1.0, |spin| f64::from(spin.balls));
        let by = RubbedBy::Drag(halves * libm::hypot(x, y));
        leaning.rubs.push(Rub { pair, by, forward: x * ax + y * ay < 0.0 });
    }

    /// Draws the line of a guide's force, which leans backwards from the normal by a leg along the guide.
    fn lean_by(
        &mut self,
        leaning: &mut Leaning,
        slide: usize,
        (along, normal): (Direction, Direction),
        tangent: Amount,
    ) {
        // Against the sliding: the leg along the guide is laid off backwards.
        let back = self.board.opposite(tangent);
        let scale = Scale { si_per_mm: LEG };
        let unit = self.board.amount(Given::exact(1.0));
        let unit = self.board.to_paper(unit, scale);
        let leg = self.board.to_paper(back, scale);
        let pole = self.board.origin();
        let foot = self.board.lay_off(pole, normal, unit);
        let tip = self.board.lay_off(foot, along, leg);
        let reason = self.reason(&[]);
        let (lean, _) = self.board.toward(pole, tip, reason);
        leaning.leans.insert(slide, lean);
    }

    /// An amount where another one is positive; elsewhere whatever is read from it is refused.
    pub(super) fn only_where(&mut self, amount: Amount, positive: Amount) -> Amount {
        let reason = self.reason_missing(Missing::Balance);
        let one = self.board.amount(Given::exact(1.0));
        let sense = self.board.in_sense_of(one, positive, reason);
        // Two, or nothing.
        let both = self.board.sum(one, sense);
        let twice = self.board.product(amount, both);
        self.board.quotient(twice, both, reason)
    }

    /// An amount where a direction has not turned by more than the last pass may turn it, with the room that this turn
    /// takes.
    fn unturned(&mut self, amount: Amount, then: Direction, now: Direction) -> Amount {
        let unit = self.board.amount(Given::exact(1.0));
        let [x, y] = self.board.components(then, unit);
        let [nx, ny] = self.board.components(now, unit);
        let (ccw, cw) = (self.board.product(x, ny), self.board.product(y, nx));
        let sine = self.board.difference(ccw, cw);
        let square = self.board.product(sine, sine);
        let most = self.board.amount(Given::exact(TURNED * TURNED));
        let room = self.board.difference(most, square);
        let amount = self.only_where(amount, room);
        // Half the square of the turn, which is another one at every place where the drawing is run.
        let either = self.board.amount(Given::within(0.0, 0.5));
        let part = self.board.product(either, square);
        let missed = self.board.product(amount, part);
        self.board.sum(amount, missed)
    }

    /// Notes where the force between a pin and a link acts; at a pin of two links that is one force.
    fn touch(&self, leaning: &mut Leaning, pin: PointId, link: LinkId, at: Point) {
        let parties = self.mechanism.parties_at(pin);
        let of: &[LinkId] = if parties.len() == 2 { &parties } else { &[link] };
        leaning.contacts.extend(of.iter().map(|link| ((pin.0, link.0), at)));
    }

    /// Where the force between a pin and a link acts.
    pub(super) fn touch_at(&mut self, balance: &Balance, pin: PointId, link: LinkId) -> Point {
        match balance.leaning.contacts.get(&(pin.0, link.0)) {
            Some(contact) => *contact,
            None => self.at(pin),
        }
    }

    /// Where the force between two links of a group acts at their pin, which one of them may hold.
    pub(super) fn inner_touch(&mut self, balance: &Balance, pin: PointId, links: [LinkId; 2]) -> Point {
        let known = links.iter().find_map(|link| balance.leaning.contacts.get(&(pin.0, link.0)));
        match known {
            Some(contact) => *contact,
            None => self.at(pin),
        }
    }

    /// The direction of a guide under a point, and the line of its force.
    pub(super) fn pressing_at(
        &mut self,
        balance: &Balance,
        slide: usize,
        at: Point,
    ) -> (Direction, Direction) {
        let (along, normal) = self.guide_at(slide, at);
        let line = balance.leaning.leans.get(&slide).copied().unwrap_or(normal);
        (along, self.guide_force_as_drawn(slide, line))
    }

    /// Whether forces pass a pin at a distance.
    pub(super) fn rubs_at(balance: &Balance, pin: PointId) -> bool {
        balance.leaning.contacts.keys().any(|(at, _)| *at == pin.0)
    }

    /// Lays the constant forces in sliding pairs off on both sides.
    pub(super) fn lay_off_drags(&mut self, balance: &mut Balance) {
        for (slide, drag) in balance.leaning.drags.clone() {
            let pair = self.mechanism.slides[slide];
            let Some(point) = self.mechanism.pin_of_slide(slide) else { continue };
            let at = self.at(point);
            let on_rider = Item { pull: Some(drag), at, couple: None };
            let on_guide = Item { pull: Some(Self::opposite(drag)), at, couple: None };
            match self.mechanism.party_of(&pair.rider) {
                Party::Link(rider) => balance.known[rider.0].push(on_rider),
                Party::Pin(pin) => balance.push_on_pin(self, pin, on_rider),
            }
            balance.known[pair.guide.link.0].push(on_guide);
        }
    }

    /// A force of a sliding pair with its drag, on the rider.
    pub(super) fn with_drag(&mut self, balance: &Balance, slide: usize, force: Pull) -> Pull {
        let Some(drag) = balance.leaning.drag(slide) else { return force };
        let head = self.chained(&[force, drag]);
        Pull { tail: self.board.origin(), head }
    }
}

/// How often each balance was drawn again.
pub(in super::super) fn redrawn(d: &Draughtsman<'_>) -> Vec<(Share, usize)> {
    d.balances.iter().map(|(share, balance)| (*share, balance.leaning.passes())).collect()
}

/// What becomes of a balance with friction on scratch paper.
struct Tried {
    /// A contact would have to pull.
    pulls: bool,
    /// The passes come to an end.
    ends: bool,
    /// How hard rough guides press then, and on which side, as parts of the largest force.
    pressing: BTreeMap<usize, f64>,
    /// The forces of the pairs that rub, on paper.
    forces: Vec<[f64; 2]>,
}

impl Tried {
    /// Whether its forces are those of another one.
    fn is_one_with(&self, other: &Self) -> bool {
        let size = |[x, y]: &[f64; 2]| libm::hypot(*x, *y);
        let largest = self.forces.iter().chain(&other.forces).map(size).fold(0.0, f64::max);
        let pairs = self.forces.iter().zip(&other.forces);
        pairs.map(|(a, b)| size(&[a[0] - b[0], a[1] - b[1]])).all(|apart| apart <= ONE * largest)
    }
}

/// A mechanism, what its links make of it, and what is drawn of it.
type Drawn<'a> = (&'a Mechanism, &'a Structure, &'a Plan);

/// Draws the balance on scratch paper, with guides that press on these sides: left of their direction, or right.
fn try_out(
    (mechanism, structure, plan): Drawn<'_>,
    pressed: &[(usize, bool)],
    begun: Begun,
) -> Option<Tried> {
    let scales = super::super::planned_scales(mechanism, structure, plan);
    let on = |board: Board| {
        let mut d = Draughtsman::new(board, mechanism, structure, scales);
        d.pressed = pressed.to_vec();
        d.begun = begun;
        super::super::drawn_by(d, plan).ok()
    };
    // Only a tape tells a tangency from a miss.
    let d = on(Board::scratch()).or_else(|| on(Board::default()))?;
    let (_, balance) = d.balances.first()?;
    let leaning = &balance.leaning;
    let of_pins = balance.of_pins.values().copied();
    let forces = of_pins.chain(balance.slides.values().map(|force| force.pull)).map(|pull| {
        let ([x, y], [from_x, from_y]) = (pull.head.value(), pull.tail.value());
        [x - from_x, y - from_y]
    });
    Some(Tried {
        pulls: balance.refused == Some(super::PULLS),
        ends: balance.refused.is_none() && !leaning.endless,
        pressing: leaning.pressing.clone(),
        forces: forces.collect(),
    })
}

/// The mechanism with a part of its friction, and with none in one of its pairs.
fn with_less(mechanism: &Mechanism, part: f64, without: Option<RubbingPair>) -> Mechanism {
    let mut less = mechanism.clone();
    let weaker =
        |roughness: Roughness| Roughness::Coefficient(Given::exact(part * libm::tan(roughness.angle())));
    let friction = &mut less.forces.friction;
    for pin in &mut friction.pins {
        pin.circle = FrictionCircle::Radius(Given::exact(part * pin.circle.radius()));
    }
    for slide in &mut friction.slides {
        let drag = |drag: Given| Given::exact(part * drag.value);
        slide.resistance = match slide.resistance {
            Resistance::Friction(roughness) => Resistance::Friction(weaker(roughness)),
            Resistance::Drag(force) => Resistance::Drag(drag(force)),
            Resistance::Both(roughness, force) => Resistance::Both(weaker(roughness), drag(force)),
        };
    }
    match without {
        Some(RubbingPair::Pin { pin, .. }) => friction.pins.retain(|rubbing| rubbing.pin != pin),
        Some(RubbingPair::Slide(slide)) => friction.slides.retain(|rubbing| rubbing.slide != slide),
        None => {}
    }
    less
}

/// Whether friction lets no balance exist, or more than one, and which pairs rub so; as the passes tell it. Where it locks
/// at a part of what is stated they come to no end beyond; a second balance is one that ends with other sides of guides,
/// and presses them there.
pub(crate) fn holds((mechanism, structure, plan): Drawn<'_>) -> Option<(Stuck, String)> {
    let ends = |part: f64, without: Option<RubbingPair>| {
        let less = with_less(mechanism, part, without);
        try_out((&less, structure, plan), &[], Begun::Plainly).is_some_and(|tried| tried.ends)
    };
    let own = try_out((mechanism, structure, plan), &[], Begun::Plainly)?;
    let pairs = mechanism.rubbing_pairs();
    if own.pulls {
        // The passes come to an end: nothing locks, and the drawing itself says what it lacks.
        return None;
    }
    if !own.ends {
        if !ends(HARDLY, None) {
            return None;
        }
        let [mut free, mut locked] = [HARDLY, 1.0];
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(free, locked);
            if ends(middle, None) { free = middle } else { locked = middle }
        }
        // Those without one of which nothing locks; all where it takes several of them.
        let guilty: Vec<RubbingPair> = pairs.iter().copied().filter(|pair| ends(1.0, Some(*pair))).collect();
        let guilty = if guilty.is_empty() { pairs } else { guilty };
        return Some((Stuck::Locked, mechanism.say_locked(&guilty, locked)));
    }
    let guides: Vec<usize> = own.pressing.keys().copied().take(MOST_GUIDES).collect();
    let others = (0..1_u32 << guides.len()).map(|pattern| {
        let sides = guides.iter().enumerate();
        sides.map(|(place, slide)| (*slide, pattern >> place & 1 == 0)).collect::<Vec<(usize, bool)>>()
    });
    let begins: &[Begun] = match mechanism.forces.friction.pins.is_empty() {
        true => &[Begun::Plainly],
        false => &[Begun::Plainly, Begun::WithPoints, Begun::TurnedRound],
    };
    let another = |(sides, begun): (&Vec<(usize, bool)>, Begun)| {
        let own_sides = sides.iter().all(|(slide, left)| (own.pressing[slide] > 0.0) == *left);
        if own_sides && begun != Begun::TurnedRound {
            return false;
        }
        let Some(tried) = try_out((mechanism, structure, plan), sides, begun) else { return false };
        // A guide that is hardly pressed in the other balance does not rub there, and fits on either side.
        let presses = |(slide, left): &(usize, bool)| {
            let pressing = tried.pressing.get(slide);
            pressing.is_none_or(|pressing| (*pressing > 0.0) == *left)
        };
        tried.ends && sides.iter().all(presses) && !tried.is_one_with(&own)
    };
    let mut others = others.flat_map(|sides| begins.iter().map(move |begun| (sides.clone(), *begun)));
    others
        .any(|(sides, begun)| another((&sides, begun)))
        .then(|| (Stuck::Ambiguous, mechanism.say_several(&pairs)))
}

/// Whether anything rubs.
pub(super) fn rubs(d: &Draughtsman<'_>) -> bool {
    !d.mechanism.forces.friction.is_empty()
}
