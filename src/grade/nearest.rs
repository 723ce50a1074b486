//! Which of many points lies nearest to a place.

use kurbo::Point;

/// Points, each with its number, halved again and again across x and y in turn.
#[derive(Debug, Default)]
pub(super) struct Nearest(Vec<(Point, usize)>);

/// A point that was found, and how far off.
type Found = Option<(f64, usize, Point)>;

impl Nearest {
    /// All coordinates are finite.
    pub(super) fn new(points: &[Point]) -> Self {
        let mut points: Vec<_> = points.iter().copied().zip(0..).collect();
        halve(&mut points, Axis::X);
        Self(points)
    }

    /// The nearest point and its distance; of several equally near, the first.
    pub(super) fn to(&self, place: Point) -> Option<(Point, f64)> {
        let mut found = None;
        search(&self.0, Axis::X, place, &mut found);
        found.map(|(distance, _, point)| (point, distance))
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

fn search(points: &[(Point, usize)], axis: Axis, place: Point, found: &mut Found) {
    let (below, rest) = points.split_at(points.len() / 2);
    let Some((&(point, number), above)) = rest.split_first() else { return };
    let distance = point.distance(place);
    if found.is_none_or(|(least, first, _)| (distance, number) < (least, first)) {
        *found = Some((distance, number, point));
    }
    let beyond = axis.of(place) - axis.of(point);
    let (near, far) = if beyond < 0.0 { (below, above) } else { (above, below) };
    search(near, axis.other(), place, found);
    if found.is_none_or(|(least, ..)| beyond.abs() <= least) {
        search(far, axis.other(), place, found);
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
            let each = points.iter().min_by(|a, b| a.distance(place).total_cmp(&b.distance(place)));
            assert_eq!(nearest.to(place).map(|(point, _)| point), each.copied());
        }
        assert_eq!(Nearest::new(&[]).to(Point::ZERO), None);
    }
}
