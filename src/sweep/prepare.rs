//! From a scene's instant to a mechanism that can move: dimensions instead of places, and what a sweep
//! watches besides what was asked.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use super::{InputKind, SweepError};
use crate::board::{Law, Variable};
use crate::given::Given;
use crate::graphical::{self, DrawError, Scales};
use crate::mechanism::quantity::{Answer, Asked, Method, Quantity, Unit};
use crate::mechanism::structure::{GroupKind, Structure};
use crate::mechanism::{
    Direction, Form, GivenPoint, Guide, GuidePoint, Input, LinkId, Mechanism, Path, Place, PointId, Rider,
    Roll, Slide,
};
use crate::plan::{Extent, Plan};

/// The links that move in a sweep: those on which something hangs that was asked for. Others may be impossible, or
/// possible in two ways.
pub(super) struct Moved(Vec<bool>);

impl Moved {
    pub(super) fn all(mechanism: &Mechanism) -> Self {
        Self(vec![true; mechanism.links.len()])
    }

    /// What the asked quantities, and what is shown besides, need.
    pub(super) fn by_asked(mechanism: &Mechanism, shown: &[Asked]) -> Result<Self, SweepError> {
        let mut asking = mechanism.clone();
        asking.asked.extend_from_slice(shown);
        let structure = Structure::of(&asking)?;
        let plan = Plan::new(&asking, &structure, Extent::Asked);
        let steps = plan.diagrams.iter().flat_map(|diagram| &diagram.steps);
        let groups: BTreeSet<usize> = steps.map(|step| step.group).collect();
        // What is fixed or driven is asked of no step.
        let moved =
            |link: usize| structure.group_of(LinkId(link)).is_none_or(|group| groups.contains(&group));
        Ok(Self((0..asking.links.len()).map(moved).collect()))
    }

    fn has(&self, link: LinkId) -> bool {
        self.0[link.0]
    }

    fn slides(&self, mechanism: &Mechanism, slide: &Slide) -> bool {
        let rider = match slide.rider {
            Rider::Pin { point, .. } => mechanism.point(point).links.iter().any(|link| self.has(*link)),
            Rider::Link { link, .. } => self.has(link),
        };
        rider && self.has(slide.guide.link)
    }
}

/// Refuses what does not stand at the scene's own place: a drawing that is to be run is not looked at there, and where its
/// lines do not meet it would run on with points at infinity.
pub(super) fn stands(mechanism: &Mechanism, shown: &[Asked]) -> Result<(), SweepError> {
    let mut asking = mechanism.clone();
    asking.asked.extend_from_slice(shown);
    let structure = Structure::of(&asking)?;
    let plan = Plan::new(&asking, &structure, Extent::Asked);
    graphical::extents(&asking, &structure, &plan.skeleton())?;
    Ok(())
}

/// The mechanism without anything that holds at one instant only; the index of its first input; and where
/// that input stands.
pub(super) fn ready(mechanism: &Mechanism, moved: &Moved) -> Result<(Mechanism, usize, f64), SweepError> {
    let mut ready = mechanism.clone();
    let place = |p: PointId| mechanism.point(p).place.exact();
    for (index, link) in mechanism.links.iter().enumerate().skip(1) {
        if link.form != Form::Placed {
            continue;
        }
        let points: Option<Vec<_>> = link.points.iter().map(|&p| place(p)).collect();
        if let Some(points) = points {
            ready.links[index].form = Form::Shape(points);
        }
    }
    for point in &mut ready.points {
        if let Place::Placed(at) = point.place {
            point.place = Place::Near(at.map(|x| x.value));
        }
    }
    for (index, slide) in mechanism.slides.iter().enumerate() {
        if !moved.slides(mechanism, slide) {
            continue;
        }
        if let Rider::Link { link, turned: None } = slide.rider {
            // It rides as placed: its own axes are the world's, from which the guide is turned at this instant.
            let along = direction_now(mechanism, slide.guide)?.ok_or_else(|| instant(mechanism, link))?;
            ready.slides[index].rider = Rider::Link { link, turned: Some(-along) };
        }
        let guide = slide.guide.link;
        let through_own_joint = match slide.guide.path {
            Path::Straight { through: GuidePoint::Point(p), .. } => {
                mechanism.link(guide).points.first() == Some(&p)
            }
            _ => false,
        };
        let stands = through_own_joint || driven(mechanism, guide) || rides(mechanism, guide);
        if mechanism.link(guide).form == Form::Single && !stands {
            return Err(SweepError::Instant(format!(
                "link {} has one joint and a guide beside it, with the world's axes at this instant: name a second point \
                 of it to move it",
                mechanism.link(guide).number
            )));
        }
    }
    for (index, input) in mechanism.inputs.iter().enumerate() {
        match (input, &mut ready.inputs[index]) {
            (
                Input::Angle { link, angle: None, .. } | Input::Speed { link, angle: None, .. },
                Input::Angle { angle, .. } | Input::Speed { angle, .. },
            ) => {
                let toward = match *mechanism.link(*link).joints() {
                    [first, second, ..] => {
                        bearing(place_now(mechanism, first)?, place_now(mechanism, second)?)
                    }
                    _ => angle_now(mechanism, *link)?,
                };
                *angle = Some(toward.ok_or_else(|| instant(mechanism, *link))?);
            }
            (Input::Slide { at: None, slide, .. }, Input::Slide { at, .. }) => {
                *at = Some(at_now(mechanism, *slide)?.ok_or_else(|| {
                    SweepError::Instant(format!(
                        "the place of the driven slide follows from placed points at this instant: give \"at\" \
                         (pair {})",
                        slide + 1
                    ))
                })?);
            }
            _ => {}
        }
    }
    let start = match ready.inputs.first() {
        Some(Input::Angle { angle: Some(at), .. } | Input::Speed { angle: Some(at), .. }) => at.value,
        Some(Input::Slide { at: Some(at), .. }) => at.value,
        _ => return Err(SweepError::Instant("there is no input to sweep".to_owned())),
    };
    // Whatever the method, the numbers are those of the polygons.
    for asked in &mut ready.asked {
        asked.method = Method::Polygon;
    }
    watch(&mut ready, moved);
    Ok((ready, 0, start))
}

/// The wheels that roll, each with its centre.
fn wheels(structure: &Structure) -> impl Iterator<Item = (LinkId, PointId)> + '_ {
    structure.groups.iter().filter_map(|group| match group.kind {
        GroupKind::Wheel { wheel, centre, .. }
        | GroupKind::Planet { wheel, centre, .. }
        | GroupKind::Rolling { wheel, centre, .. } => Some((wheel, centre)),
        _ => None,
    })
}

/// Whether a wheel has more than its centre: where that goes follows from how far it has rolled.
fn carries_more(mechanism: &Mechanism, wheel: LinkId) -> bool {
    let guides = mechanism.slides.iter().any(|slide| slide.guide.link == wheel);
    let lines = mechanism.rolls.iter().any(|roll| match roll {
        Roll::Line { guide, .. } => guide.link == wheel,
        Roll::Circles { .. } => false,
    });
    guides || lines || mechanism.link(wheel).points.len() > 1
}

/// Where a wheel's points go follows from how far it has rolled, and no drawing of one position tells that.
pub(super) fn refuse_rolled_points(mechanism: &Mechanism, structure: &Structure) -> Result<(), SweepError> {
    match wheels(structure).find(|(wheel, _)| carries_more(mechanism, *wheel)) {
        Some((wheel, _)) => Err(SweepError::Instant(format!(
            "where the points of wheel {} go follows from how far it has rolled, which a drawing of one position \
             does not tell",
            mechanism.link(wheel).number
        ))),
        None => Ok(()),
    }
}

/// Why a drawing cannot be run: a wheel's centre that the scene places, and that nothing leads on but rolling, stands where it
/// does at this instant only.
pub(super) fn left_to_rolling(placed: &Mechanism, error: DrawError) -> SweepError {
    match error {
        DrawError::NotPlaced { point } if placed.point(point).place.exact().is_some() => {
            let name = &placed.point(point).name;
            SweepError::Instant(format!(
                "where {name} goes follows from rolling alone, from where it is placed at this instant, and a sweep does \
                 not lead it on: drive what carries {name}, a link or a slide, in the place of the wheel"
            ))
        }
        error => error.into(),
    }
}

/// Wheels that roll on in a sweep, from where they stand at the scene's instant.
#[derive(Debug, Clone, Default)]
pub(super) struct Wheels {
    /// Each with its centre; none where no wheel has points, and how none turns is not asked.
    pub(super) rolling: Vec<(LinkId, PointId)>,
    /// Where their points stand, by point; empty where none rolls on.
    pub(super) starts: Vec<Option<GivenPoint>>,
}

/// Which wheels roll on, and where their points stand at the scene's instant.
pub(super) fn wheels_rolling_on(
    placed: &Mechanism,
    ready: &Mechanism,
    structure: &Structure,
    moved: &Moved,
) -> Result<Wheels, SweepError> {
    let is_asked = |wheel: LinkId| {
        ready.asked.iter().any(|asked| matches!(asked.quantity, Quantity::Angle(link) if link == wheel))
    };
    let rolls_on = |wheel: LinkId| moved.has(wheel) && (carries_more(ready, wheel) || is_asked(wheel));
    let rolling: Vec<_> = wheels(structure).filter(|(wheel, _)| rolls_on(*wheel)).collect();
    let mut starts = vec![None; if rolling.is_empty() { 0 } else { ready.points.len() }];
    for &(wheel, centre) in &rolling {
        let link = ready.link(wheel);
        for &point in &link.points {
            starts[point.0] = placed.point(point).place.exact();
        }
        if starts[centre.0].is_none() {
            starts[centre.0] = match now(placed, Quantity::Position(centre))? {
                Some(Answer::Vector { value, bound }) => Some(value.map(|x| Given::within(x, bound))),
                _ => None,
            };
        }
        let marked = link.points.iter().any(|&p| p != centre && starts[p.0].is_some());
        if link.points.len() > 1 && !(marked && starts[centre.0].is_some()) {
            return Err(SweepError::Instant(format!(
                "nothing says how wheel {} stands at the scene's instant: place one of its points",
                link.number
            )));
        }
    }
    Ok(Wheels { rolling, starts })
}

/// Whether a pin rides on a guide of the frame.
pub(super) fn is_guided(mechanism: &Mechanism, pin: PointId) -> bool {
    let rides = |rider: Rider| matches!(rider, Rider::Pin { point, .. } if point == pin);
    mechanism.slides.iter().any(|s| s.guide.link == LinkId::FRAME && rides(s.rider))
}

fn driven(mechanism: &Mechanism, link: LinkId) -> bool {
    mechanism
        .inputs
        .iter()
        .any(|i| matches!(i, Input::Angle { link: l, .. } | Input::Speed { link: l, .. } if *l == link))
}

/// Whether a link rides on a guide without turning against it, in a way that is stated.
fn rides(mechanism: &Mechanism, link: LinkId) -> bool {
    let rider = |rider: &Rider| matches!(rider, Rider::Link { link: l, turned: Some(_) } if *l == link);
    mechanism.slides.iter().any(|slide| rider(&slide.rider))
}

fn instant(mechanism: &Mechanism, link: LinkId) -> SweepError {
    let number = mechanism.link(link).number;
    SweepError::Instant(format!(
        "link {number} stands as placed at this instant: give its own dimensions to move it"
    ))
}

/// Adds what a sweep watches of the links that move: the places of pins on guides of the frame, the angles of links pivoted to it,
/// the transmission angles of four-bar loops.
fn watch(mechanism: &mut Mechanism, moved: &Moved) {
    let unit = |symbol: &str, si: f64| Unit { symbol: symbol.to_owned(), si };
    let mut wanted: Vec<(String, Quantity, Unit)> = Vec::new();
    for slide in mechanism.slides.iter().filter(|slide| moved.slides(mechanism, slide)) {
        if let (Rider::Pin { point, .. }, LinkId::FRAME) = (slide.rider, slide.guide.link) {
            let name = format!("x({})", mechanism.point(point).name);
            wanted.push((name, Quantity::Position(point), unit("m", 1.0)));
        }
    }
    for link in mechanism.moving().filter(|link| moved.has(*link)) {
        let here = mechanism.link(link);
        let pivot = here.points.iter().find(|&&p| mechanism.is_fixed(p));
        if here.block || pivot.is_none() || here.points.len() < 2 || driven(mechanism, link) {
            continue;
        }
        let name = format!("angle({})", here.number);
        wanted.push((name, Quantity::Angle(link), unit("deg", PI / 180.0)));
        for pin in &mechanism.pins {
            let other = match pin.links {
                [a, b] if a == link => b,
                [a, b] if b == link => a,
                _ => continue,
            };
            let bar = !mechanism.link(other).block && mechanism.link(other).points.len() > 1;
            if other == LinkId::FRAME || !bar || !moved.has(other) {
                continue;
            }
            let name = format!("transmission({}/{})", mechanism.link(other).number, here.number);
            wanted.push((name, Quantity::Transmission(other, link), unit("deg", PI / 180.0)));
        }
    }
    for (name, quantity, unit) in wanted {
        if !mechanism.asked.iter().any(|a| a.quantity == quantity) {
            mechanism.asked.push(Asked { name, quantity, unit, method: Method::Polygon });
        }
    }
}

/// Brings the inputs to a place of what is varied.
pub(super) fn lead(mechanism: &mut Mechanism, variable: &Variable, at: f64) {
    // A place of the sweep is uncertain by a unit in its last place, as it is where the sweep runs.
    let near = |value: f64| Given::within(value, f64::EPSILON * value.abs());
    match variable {
        Variable::Input(swept) => match mechanism.inputs.get_mut(*swept) {
            Some(Input::Angle { angle, .. } | Input::Speed { angle, .. }) => *angle = Some(near(at)),
            Some(Input::Slide { at: place, .. }) => *place = Some(near(at)),
            None => {}
        },
        Variable::Time(laws) => {
            for (input, law) in mechanism.inputs.iter_mut().zip(laws) {
                let way = (law.rate.value + law.acceleration.value / 2.0 * at) * at;
                let moved = |place: &mut Option<Given>| {
                    if let Some(place) = place {
                        let value = place.value + way;
                        let rounding = f64::EPSILON * (place.value.abs() + 3.0 * way.abs());
                        *place = Given::within(value, place.error + rounding);
                    }
                };
                let now = law.rate.value + law.acceleration.value * at;
                let rounding =
                    f64::EPSILON * (law.rate.value.abs() + 2.0 * (law.acceleration.value * at).abs());
                let now = Given::within(now, law.rate.error + rounding);
                match input {
                    Input::Angle { angle, omega, .. } => {
                        moved(angle);
                        *omega = now;
                    }
                    Input::Slide { at, velocity, .. } => {
                        moved(at);
                        *velocity = now;
                    }
                    // Made into an angle with its ω before the sweep began.
                    Input::Speed { angle, .. } => moved(angle),
                }
            }
        }
    }
}

/// How every input moves in time. An input given by the speed of a point becomes one given by its ω, as drawn at this
/// instant: a constant ω, or what ε makes of it.
pub(super) fn laws(mechanism: &mut Mechanism) -> Result<Vec<Law>, SweepError> {
    for index in 0..mechanism.inputs.len() {
        if let Input::Speed { link, angle, alpha, .. } = mechanism.inputs[index] {
            let omega = omega_now(mechanism, link)?;
            mechanism.inputs[index] = Input::Angle { link, angle, omega, alpha };
        }
    }
    let laws: Vec<Law> = mechanism
        .inputs
        .iter()
        .map(|input| match *input {
            Input::Angle { omega: rate, alpha: acceleration, .. }
            | Input::Speed { speed: rate, alpha: acceleration, .. }
            | Input::Slide { velocity: rate, acceleration, .. } => Law { rate, acceleration },
        })
        .collect();
    if laws.iter().all(|law| law.rate.value == 0.0 && law.acceleration.value == 0.0) {
        return Err(SweepError::Instant(
            "nothing moves in time: give the input a rate, such as \"omega\"".to_owned(),
        ));
    }
    Ok(laws)
}

/// ω of a link as it is drawn at this instant, with its bound.
fn omega_now(mechanism: &Mechanism, link: LinkId) -> Result<Given, SweepError> {
    match now(mechanism, Quantity::Omega(link))? {
        Some(Answer::Scalar { value, bound }) => Ok(Given::within(value, bound)),
        _ => Err(SweepError::Instant("the speed of the input does not tell how fast it turns".to_owned())),
    }
}

/// What a drawing of this instant says of a quantity.
fn now(mechanism: &Mechanism, quantity: Quantity) -> Result<Option<Answer>, SweepError> {
    let unit = Unit { symbol: String::new(), si: 1.0 };
    let mut only = mechanism.clone();
    only.asked = vec![Asked { name: String::new(), quantity, unit, method: Method::Polygon }];
    let structure = Structure::of(&only)?;
    let plan = Plan::new(&only, &structure, Extent::Asked);
    let scales = Scales::new(|_| 1.0);
    let drawn = graphical::construct(&only, &structure, &plan, scales)?;
    Ok(drawn.construction.answers.into_iter().next().map(|reading| reading.answer))
}

/// Where a point stands at this instant.
fn place_now(mechanism: &Mechanism, point: PointId) -> Result<Option<GivenPoint>, SweepError> {
    if let Some(place) = mechanism.point(point).place.exact() {
        return Ok(Some(place));
    }
    Ok(match now(mechanism, Quantity::Position(point))? {
        Some(Answer::Vector { value, bound }) => Some(value.map(|x| Given::within(x, bound))),
        _ => None,
    })
}

/// How a link's own x-axis points at this instant, radians.
fn angle_now(mechanism: &Mechanism, link: LinkId) -> Result<Option<Given>, SweepError> {
    if mechanism.link(link).form == Form::Placed {
        return Ok(Some(Given::exact(0.0)));
    }
    Ok(match now(mechanism, Quantity::Angle(link))? {
        Some(Answer::Scalar { value, bound }) => Some(Given::within(value, bound)),
        _ => None,
    })
}

/// The direction from one place to another, radians.
fn bearing(from: Option<GivenPoint>, to: Option<GivenPoint>) -> Option<Given> {
    let (a, b) = (from?, to?);
    let [dx, dy] = [0, 1].map(|k| b[k].value - a[k].value);
    let error = a.iter().chain(&b).map(|c| c.error).sum::<f64>() / libm::hypot(dx, dy);
    error.is_finite().then(|| Given::within(libm::atan2(dy, dx), error + 4.0 * f64::EPSILON))
}

/// Where the start of a straight guide stands at this instant, before it is shifted to its left.
fn start_now(mechanism: &Mechanism, guide: Guide) -> Result<Option<GivenPoint>, SweepError> {
    match guide.path {
        Path::Straight { through: GuidePoint::Point(point), .. } => place_now(mechanism, point),
        Path::Straight { through: GuidePoint::Own(at), .. }
            if mechanism.link(guide.link).form == Form::Placed =>
        {
            Ok(Some(at))
        }
        _ => Ok(None),
    }
}

/// The direction of a straight guide at this instant, radians from +x.
fn direction_now(mechanism: &Mechanism, guide: Guide) -> Result<Option<Given>, SweepError> {
    let Path::Straight { direction, turned, .. } = guide.path else { return Ok(None) };
    let base = match direction {
        Direction::Angle(angle) => {
            let own = angle_now(mechanism, guide.link)?;
            own.map(|own| Given::within(own.value + angle.value, own.error + angle.error))
        }
        Direction::Toward(to) => bearing(start_now(mechanism, guide)?, place_now(mechanism, to)?),
    };
    let sum = |base: Given| {
        let value = base.value + turned.value;
        Given::within(value, base.error + turned.error + f64::EPSILON * (value.abs() + 1.0))
    };
    Ok(base.map(sum))
}

/// How far along its guide the rider of a sliding pair stands at this instant, metres.
fn at_now(mechanism: &Mechanism, slide: usize) -> Result<Option<Given>, SweepError> {
    let Slide { rider, guide } = mechanism.slides[slide];
    let rider = match rider {
        Rider::Pin { point, .. } => Some(point),
        Rider::Link { link, .. } => mechanism.link(link).points.first().copied(),
    };
    let Some(rider) = rider else { return Ok(None) };
    let (start, along) = (start_now(mechanism, guide)?, direction_now(mechanism, guide)?);
    let (Some(start), Some(along), Some(at)) = (start, along, place_now(mechanism, rider)?) else {
        return Ok(None);
    };
    let [dx, dy] = [0, 1].map(|k| at[k].value - start[k].value);
    let (sin, cos) = libm::sincos(along.value);
    let away = libm::hypot(dx, dy);
    let error =
        at.iter().chain(&start).map(|c| c.error).sum::<f64>() + away * (along.error + 4.0 * f64::EPSILON);
    Ok(Some(Given::within(dx * cos + dy * sin, error)))
}

/// The span of time to walk, and whether everything comes again after it: in seconds from the scene's instant.
pub(super) fn span(
    input: InputKind,
    stated: Option<[f64; 2]>,
    laws: &[Law],
    mechanism: &Mechanism,
    moved: &Moved,
) -> Result<([f64; 2], bool), SweepError> {
    let way = match input {
        InputKind::Slide(_) => 2.0 * reach(mechanism, moved),
        _ => 2.0 * PI,
    };
    let turns = matches!(input, InputKind::Angle(_));
    let uniform = laws.iter().all(|law| law.acceleration.value == 0.0) && laws.len() == 1;
    let whole = laws.first().map_or(f64::INFINITY, |law| time_for(way, *law));
    match stated {
        Some([from, to]) if from < to && (to - from).is_finite() => {
            if !(from..=to).contains(&0.0) {
                let what = "the scene's own instant, 0, must lie in the span of time";
                return Err(SweepError::Range(what.to_owned()));
            }
            Ok(([from, to], uniform && turns && from == 0.0 && to == whole))
        }
        Some(_) => {
            Err(SweepError::Range("the span of time ends before it begins: --from is the earlier".to_owned()))
        }
        None if whole.is_finite() && whole > 0.0 => Ok(([0.0, whole], uniform && turns)),
        None => Err(SweepError::Range(
            "the first input stands still: say how long to look with --from and --to".to_owned(),
        )),
    }
}

/// When an input has first gone so far, to either side: |v t + a t²/2| = way. Without a difference of roots that
/// nearly cancel.
fn time_for(way: f64, law: Law) -> f64 {
    // With v to the right; a speed that is lost and regained the other way counts as well.
    let (v, a) =
        (law.rate.value.abs(), law.acceleration.value * if law.rate.value < 0.0 { -1.0 } else { 1.0 });
    if a == 0.0 {
        return way / v;
    }
    let ahead = v * v + 2.0 * a * way;
    if ahead >= 0.0 {
        return 2.0 * way / (v + ahead.sqrt());
    }
    (v + (v * v - 2.0 * a * way).sqrt()) / -a
}

/// Longer than the links that move can reach: the sum of their dimensions.
fn reach(mechanism: &Mechanism, moved: &Moved) -> f64 {
    let longest = |form: &Form| match form {
        Form::Length(l) => l.value,
        Form::Line(p) => p.iter().map(|x| x.value.abs()).fold(0.0, f64::max),
        Form::Sides { first_second, third_first, .. } => first_second.value.max(third_first.value),
        Form::Arms { second, third, .. } => second.value.max(third.value),
        Form::Shape(p) => p.iter().flatten().map(|x| x.value.abs()).fold(0.0, f64::max),
        Form::Placed | Form::Single => 0.0,
    };
    let links = mechanism.links.iter().zip(&moved.0).filter(|(_, moved)| **moved);
    links.map(|(link, _)| longest(&link.form)).sum()
}

/// The range to walk, the start in it, and whether it is a whole turn.
pub(super) fn range(
    input: InputKind,
    stated: Option<[f64; 2]>,
    start: f64,
    mechanism: &Mechanism,
    moved: &Moved,
) -> Result<([f64; 2], f64, bool), SweepError> {
    let turn = 2.0 * PI;
    let range = match (stated, input) {
        (Some([from, to]), _) if from < to && (to - from).is_finite() => [from, to],
        // Which way it is walked is told by the motion.
        (Some([to, from]), _) if from < to && (to - from).is_finite() => [from, to],
        (Some(_), _) => {
            return Err(SweepError::Range("the range has no length: --from and --to must differ".to_owned()));
        }
        (None, InputKind::Angle(_) | InputKind::Time) => [0.0, turn],
        (None, InputKind::Slide(_)) => {
            let reach = reach(mechanism, moved);
            [start - 2.0 * reach, start + 2.0 * reach]
        }
    };
    let whole = matches!(input, InputKind::Angle(_)) && range[1] - range[0] == turn;
    // The end of a range and the scene's own place are read by different roundings.
    let hair = 8.0 * f64::EPSILON * range[0].abs().max(range[1].abs()).max(start.abs());
    let start = match input {
        // Where the range is longer than a turn, how often the input has gone round may matter.
        InputKind::Angle(_) if !whole && (range[0]..=range[1]).contains(&start) => start,
        InputKind::Angle(_) => start + turn * ((range[0] - hair - start) / turn).ceil(),
        InputKind::Slide(_) | InputKind::Time => start,
    };
    // Rounding may put it a hair's breadth beyond, or before.
    let start = if whole { start.clamp(range[0], range[1]) } else { start };
    let start = range.into_iter().find(|end| !whole && (end - start).abs() <= hair).unwrap_or(start);
    if !(range[0]..=range[1]).contains(&start) {
        return Err(SweepError::Range(
            "the scene's own position must lie in the range: from there on the sweep knows which assembly is meant"
                .to_owned(),
        ));
    }
    Ok((range, start, whole))
}
