//! Which diagrams of a sweep are drawn: what goes to and fro is shown signed, its place, velocity and acceleration under
//! each other over one axis, as textbooks draw them; what moves in the plane as a size, a path or hodograph, and polar.

use std::f64::consts::FRAC_PI_2;

use crate::board::Dual;
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{LinkId, PointId};
use crate::sweep::{InputKind, Sweep};

/// What a panel shows.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Panel {
    /// A number over the input: one column, or the length of a vector of two.
    Over(Vec<usize>),
    /// A vector that keeps its line, over the input: its signed size along this unit vector.
    Along([usize; 2], [f64; 2]),
    /// Two columns against each other: a path or a hodograph.
    Plane([usize; 2]),
    /// The length of a vector of two columns, laid off in the direction of the input.
    Polar([usize; 2]),
}

/// A number with its change by the input.
pub(super) type Rate = (f64, f64);

impl Panel {
    pub(super) fn columns(&self) -> &[usize] {
        match self {
            Self::Over(columns) => columns,
            Self::Along(columns, _) | Self::Plane(columns) | Self::Polar(columns) => columns,
        }
    }

    /// Whether it shows a length, which is never negative.
    pub(super) fn is_length(&self) -> bool {
        match self {
            Self::Over(columns) => columns.len() == 2,
            Self::Polar(_) => true,
            Self::Along(..) | Self::Plane(_) => false,
        }
    }

    /// The number that it shows.
    pub(super) fn number(&self, values: &[Option<Dual>]) -> Option<Rate> {
        let get = |c: usize| values.get(c).copied().flatten();
        match (self, self.columns()) {
            (Self::Along(_, [ux, uy]), &[x, y]) => {
                let (x, y) = (get(x)?, get(y)?);
                Some((x.value * ux + y.value * uy, x.slope * ux + y.slope * uy))
            }
            (_, &[x, y]) => {
                let (x, y) = (get(x)?, get(y)?);
                let length = libm::hypot(x.value, y.value);
                let change =
                    if length > 0.0 { (x.value * x.slope + y.value * y.slope) / length } else { 0.0 };
                Some((length, change))
            }
            (_, &[c]) => get(c).map(|m| (m.value, m.slope)),
            _ => None,
        }
    }
}

/// Whose motion a panel tells, and of which order: such panels stand under each other.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    Point(PointId),
    Link(LinkId),
}

fn told(quantity: Quantity) -> Option<(Of, u8)> {
    Some(match quantity {
        Quantity::Position(p) => (Of::Point(p), 0),
        Quantity::Velocity(p) => (Of::Point(p), 1),
        Quantity::Acceleration(p) => (Of::Point(p), 2),
        Quantity::Angle(l) => (Of::Link(l), 0),
        Quantity::Omega(l) => (Of::Link(l), 1),
        Quantity::Alpha(l) => (Of::Link(l), 2),
        _ => return None,
    })
}

/// Panels over one axis, each with the order of what it shows; and whose motion they tell.
struct Stack {
    of: Option<Of>,
    panels: Vec<(u8, Panel)>,
}

/// The panels of what was asked, in stacks over one axis each. `looks` gives columns at places over the whole range.
pub(super) fn stacks(sweep: &Sweep, looks: impl Fn(&[usize]) -> Vec<Vec<Option<Dual>>>) -> Vec<Vec<Panel>> {
    let mut all: Vec<Stack> = Vec::new();
    let mut single: Vec<(usize, Panel)> = Vec::new();
    let stacked = |all: &mut Vec<Stack>, quantity, panel: Panel| {
        let (of, order) = told(quantity).map_or((None, 0), |(of, order)| (Some(of), order));
        match all.iter_mut().find(|stack| stack.of.is_some() && stack.of == of) {
            Some(stack) => stack.panels.push((order, panel)),
            None => all.push(Stack { of, panels: vec![(order, panel)] }),
        }
    };
    for (c, column) in sweep.columns.iter().enumerate().filter(|(_, column)| !column.watched) {
        let quantity = column.asked.quantity;
        let pair = [c, c + 1];
        match (column.axis, quantity) {
            (None, _) => stacked(&mut all, quantity, Panel::Over(vec![c])),
            (Some(0), _) => {
                let place = matches!(quantity, Quantity::Position(_) | Quantity::Centre(..));
                let line = matches!(told(quantity), Some((Of::Point(_), _)))
                    .then(|| line_of(&looks(&pair), pair, place))
                    .flatten();
                match (line, place) {
                    (Some(line), _) => stacked(&mut all, quantity, Panel::Along(pair, line)),
                    (None, true) => {
                        single.push((all.len(), Panel::Plane(pair)));
                        if column.motion {
                            single.extend(pair.map(|c| (all.len(), Panel::Over(vec![c]))));
                        }
                    }
                    (None, false) => {
                        single.push((all.len(), Panel::Over(pair.to_vec())));
                        single.push((all.len(), Panel::Plane(pair)));
                    }
                }
                if !place && sweep.whole_turn && matches!(sweep.input, InputKind::Angle(_)) {
                    single.push((all.len(), Panel::Polar(pair)));
                }
            }
            _ => {}
        }
    }
    // Each where it was first asked for; a stack in the order of its derivatives.
    let mut single = single.into_iter().peekable();
    let mut stacks = Vec::new();
    for (index, Stack { panels: mut stack, .. }) in all.into_iter().enumerate() {
        while let Some((_, panel)) = single.next_if(|(before, _)| *before <= index) {
            stacks.push(vec![panel]);
        }
        stack.sort_by_key(|(order, _)| *order);
        stacks.push(stack.into_iter().map(|(_, panel)| panel).collect());
    }
    stacks.extend(single.map(|(_, panel)| vec![panel]));
    // What stands under each other comes first: the others find room beside and below.
    stacks.sort_by_key(|stack: &Vec<Panel>| stack.len() == 1);
    stacks
}

/// The line that a vector keeps in all positions, as a unit vector to the right, or upwards: of places that along which they
/// move. `None` where it has no line, or no size.
fn line_of(looks: &[Vec<Option<Dual>>], [x, y]: [usize; 2], place: bool) -> Option<[f64; 2]> {
    /// What lies nearer to the line, as a part of the greatest size, lies on it.
    const STRAIGHT: f64 = 1e-9;
    /// The same, in errors.
    const ERRORS: f64 = 64.0;
    let pairs = looks.iter().filter_map(|values| {
        let (x, y) = (values.get(x).copied().flatten()?, values.get(y).copied().flatten()?);
        Some(([x.value, y.value], x.error.max(y.error)))
    });
    let pairs: Vec<([f64; 2], f64)> = pairs.collect();
    let first = pairs.first().filter(|_| place).map(|(at, _)| *at);
    let from_first = |at: [f64; 2]| first.map_or(at, |first| [at[0] - first[0], at[1] - first[1]]);
    let sizes = pairs.iter().map(|(at, error)| (from_first(*at), error));
    let size = |v: [f64; 2]| libm::hypot(v[0], v[1]);
    let (farthest, error) = sizes.max_by(|(a, _), (b, _)| size(*a).total_cmp(&size(*b)))?;
    let most = size(farthest);
    let scale = pairs.iter().map(|(at, _)| size(*at)).fold(0.0, f64::max);
    if most <= ERRORS * error || most <= STRAIGHT * scale {
        return None;
    }
    let mut along = farthest.map(|part| part / most);
    for axis in 0..2 {
        if along[axis].abs() <= STRAIGHT {
            along[axis] = 0.0;
            along[1 - axis] = 1.0;
        }
    }
    if along[0] < 0.0 || (along[0] == 0.0 && along[1] < 0.0) {
        along = along.map(|part| -part);
    }
    let strays = |(at, error): &([f64; 2], f64)| {
        let v = from_first(*at);
        (v[0] * along[1] - v[1] * along[0]).abs() > STRAIGHT * scale + ERRORS * error
    };
    (!pairs.iter().any(strays)).then_some(along)
}

/// The direction of a line from the x-axis, rad.
pub(super) fn direction(along: [f64; 2]) -> f64 {
    if along[0] == 0.0 { FRAC_PI_2 } else { libm::atan2(along[1], along[0]) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    /// A crank of 40 mm and a rod of 130 mm, its guide at an angle: the pin keeps the guide's line.
    fn swept(guide: f64) -> Sweep {
        let (cos, sin) = (libm::cos(guide.to_radians()), libm::sin(guide.to_radians()));
        let text = format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O", "A"], "length": 40 }}, "3": {{ "joins": ["A", "B"], "length": 130 }} }},
            "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, 0], "angle": {guide} }} }} ],
            "near": {{ "B": [{}, {}] }}, "input": {{ "link": 2, "angle": 30, "omega": "10 rad/s ccw" }},
            "find": ["a(B)", "v(A)", "v(B)", "x(B)", "omega(3)"] }}"#,
            130.0 * cos,
            130.0 * sin
        );
        Sweep::new(&scene::read(&text, "test").unwrap().mechanism, None).unwrap()
    }

    fn looks(sweep: &Sweep) -> Vec<Vec<Option<Dual>>> {
        (0..72).filter_map(|i| sweep.at(f64::from(i) * 5_f64.to_radians())).collect()
    }

    #[test]
    fn what_goes_to_and_fro_stands_signed_in_a_stack_of_its_derivatives() {
        let sweep = swept(0.0);
        let stacks = stacks(&sweep, |_| looks(&sweep));
        let [Panel::Along([x, _], along), Panel::Along([v, _], _), Panel::Along([a, _], _)] = &stacks[0][..]
        else {
            panic!("{stacks:?}")
        };
        assert_eq!(along, &[1.0, 0.0]);
        let quantity = |c: &usize| sweep.columns[*c].asked.name.as_str();
        assert_eq!([x, v, a].map(quantity), ["x(B)", "v(B)", "a(B)"]);
        // At 90° the rod only translates: v = −ω r, whatever its length.
        let values = sweep.at(FRAC_PI_2).unwrap();
        let (value, _) = stacks[0][1].number(&values).unwrap();
        assert!((value + 10.0 * 0.04).abs() < 1e-12, "{value}");
        // The crank pin goes round: it has a hodograph, the slider has none.
        let planes: Vec<&str> = stacks
            .iter()
            .flatten()
            .filter(|p| matches!(p, Panel::Plane(_)))
            .map(|p| quantity(&p.columns()[0]))
            .collect();
        assert_eq!(planes, ["v(A)"]);
    }

    #[test]
    fn an_inclined_guide_is_the_positive_direction() {
        for (guide, positive) in [(35.0, 35.0), (90.0, 90.0), (160.0, -20.0)] {
            let sweep = swept(guide);
            let stacks = stacks(&sweep, |_| looks(&sweep));
            let Panel::Along(_, along) = &stacks[0][0] else { panic!("{stacks:?}") };
            assert!((direction(*along).to_degrees() - positive).abs() < 1e-7, "{guide}: {along:?}");
        }
    }
}
