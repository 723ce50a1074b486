//! Which of many points lie near a place.

use kurbo::Point;

/// Points, each with its number, halved again and again across x and y in turn.
#[derive(Debug, Default)]
pub(super) struct Nearest(Vec<(Point, usize)>);

impl Nearest {
    /// All coordinates are finite.
    pub(super) fn new(points: &[Point]) -> Self {
        let mut points: Vec<_> = points.iter().copied().zip(0..).collect();
        halve(&mut points, Axis::X);
        Self(points)
    }

    /// The number and the distance of every point within a distance of a place, the nearest first; no more than `most`.
    pub(super) fn within(&self, place: Point, far: f64, most: usize) -> Vec<(usize, f64)> {
        let mut found = Vec::new();
        collect(&self.0, Axis::X, place, far, &mut found);
        found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        found.truncate(most);
        found
    }
}

#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
}

impl Axis {
    fn of(self, point: Point) -> f64 {
        match self {
            Self::X => point.x,
            Self::Y => point.y,
        }
    }

    fn other(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::X,
        }
    }
}

fn halve(points: &mut [(Point, usize)], axis: Axis) {
    if points.len() < 2 {
        return;
    }
    let middle = points.len() / 2;
    let (below, _, above) =
        points.select_nth_unstable_by(middle, |(a, _), (b, _)| axis.of(*a).total_cmp(&axis.of(*b)));
    halve(below, axis.other());
    halve(above, axis.other());
}

fn collect(points: &[(Point, usize)], axis: Axis, place: Point, far: f64, found: &mut Vec<(usize, f64)>) {
    let (below, rest) = points.split_at(points.len() / 2);
    let Some((&(point, number), above)) = rest.split_first() else { return };
    let distance = point.distance(place);
    if distance <= far {
        found.push((number, distance));
    }
    let beyond = axis.of(place) - axis.of(point);
    if beyond <= far {
        collect(below, axis.other(), place, far, found);
    }
    if beyond >= -far {
        collect(above, axis.other(), place, far, found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_one_that_looking_at_each_finds() {
        let mut seed = 1_u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 24)
        };
        let points: Vec<Point> = (0..500).map(|_| Point::new(next(), next())).collect();
        let nearest = Nearest::new(&points);
        for _ in 0..500 {
            let place = Point::new(next(), next());
            let mut each: Vec<(usize, f64)> = points
                .iter()
                .map(|p| p.distance(place))
                .enumerate()
                .filter(|(_, far)| *far <= 30.0)
                .collect();
            each.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            assert_eq!(nearest.within(place, 30.0, usize::MAX), each);
            each.truncate(2);
            assert_eq!(nearest.within(place, 30.0, 2), each);
        }
        assert!(Nearest::new(&[]).within(Point::ZERO, 1.0, 1).is_empty());
    }
}
