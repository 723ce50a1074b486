//! Places that a figure states: each point by two loci from points that stand already.
//!
//! Here stands only what the figure says. Each solver finds the places by its own means, the drawing with ruler
//! and compass, the other by equations.

use std::f64::consts::FRAC_PI_2;

use super::{Given, Mechanism, Path, Place, PointId};

/// An error of so large a part of the coordinates is a room.
const DIGITS: f64 = 1e-12;

/// Where a point may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Locus {
    /// At this distance from a point that stands.
    Circle {
        /// The centre.
        centre: PointId,
        /// Metres, positive.
        radius: Given,
    },
    /// On the ray that leaves a point in a direction.
    Ray {
        /// Where it begins.
        from: PointId,
        /// From +x, ccw, radians.
        direction: Given,
    },
    /// On the line through a point that is square to the line through two points.
    Square {
        /// A point of the line.
        through: PointId,
        /// Two points that stand in different places.
        to: [PointId; 2],
    },
    /// Where a segment is seen at an angle: turned ccw by `angle` about the point, the direction to the first end
    /// becomes that to the second. A right angle has no sense: there the whole circle counts.
    Sees {
        /// The ends of the segment.
        ends: [PointId; 2],
        /// In (−π, π), not zero, radians.
        angle: Given,
    },
    /// On a line or an arc that stands in the world: own coordinates and angles are the world's at this instant.
    On(Path),
}

/// How a stated place goes together with what else the scene says of the point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Standing {
    /// Nothing else holds the point: it stands where it is stated.
    Stated,
    /// A given dimension or guide holds as well: the point stands where that is met square on from the stated place.
    /// A figure's digits differ from it by rounding at most.
    Onto(Locus),
    /// Two given dimensions or guides hold: the point stands at their meet next to the stated place.
    AtMeet([Locus; 2]),
    /// Dimensions and guides say where the point is: the statement only chooses the assembly, and must agree.
    Hint,
    /// The point is where its driven link leads it; the statement is that link's length and angle, for others to be
    /// stated from it.
    Driven,
}

/// What a figure states of the place of one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statement {
    /// The point.
    pub point: PointId,
    /// The two loci on which it lies.
    pub loci: [Locus; 2],
    /// A rough place, which chooses between two meets.
    pub near: Option<[f64; 2]>,
    /// How it goes together with the rest of the scene.
    pub standing: Standing,
}

/// The points that a path names.
fn named(path: &Path) -> impl Iterator<Item = PointId> {
    let name = |point: super::GuidePoint| match point {
        super::GuidePoint::Point(point) => Some(point),
        super::GuidePoint::Own(_) => None,
    };
    let names = match *path {
        Path::Straight { through, direction: super::Direction::Toward(point), .. } => {
            [name(through), Some(point)]
        }
        Path::Straight { through, .. } => [name(through), None],
        Path::Arc { centre, .. } => [name(centre), None],
    };
    names.into_iter().flatten()
}

impl Locus {
    /// The points that must stand before the locus can be drawn.
    #[must_use]
    pub fn hangs_on(&self) -> Vec<PointId> {
        match self {
            Self::Circle { centre, .. } => vec![*centre],
            Self::Ray { from, .. } => vec![*from],
            Self::Square { through, to } => vec![*through, to[0], to[1]],
            Self::Sees { ends, .. } => ends.to_vec(),
            Self::On(path) => named(path).collect(),
        }
    }

    /// Whether the locus leads through a point by what is stated, whatever the numbers are.
    #[must_use]
    pub fn leads_through(&self, point: PointId) -> bool {
        match self {
            Self::Circle { .. } => false,
            Self::Ray { from, .. } => *from == point,
            Self::Square { through, .. } => *through == point,
            Self::Sees { ends, .. } => ends.contains(&point),
            Self::On(Path::Arc { .. }) => false,
            Self::On(Path::Straight { through, direction, turned, offset }) => {
                let along = *turned == Given::exact(0.0) && *direction == super::Direction::Toward(point);
                *offset == Given::exact(0.0) && (*through == super::GuidePoint::Point(point) || along)
            }
        }
    }

    /// The ends of a segment that is seen at an angle, where the other locus leads through them: both meet there, and
    /// from there the segment is seen at no angle.
    #[must_use]
    pub fn blind_ends(loci: &[Self; 2]) -> Vec<PointId> {
        let [first, second] = loci;
        let mut blind = Vec::new();
        for (one, other) in [(first, second), (second, first)] {
            if let Self::Sees { ends, .. } = one {
                blind.extend(ends.iter().copied().filter(|end| other.leads_through(*end)));
            }
        }
        blind.sort_unstable();
        blind.dedup();
        blind
    }

    /// A right angle is seen from a whole circle; any other from an arc of one.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        match self {
            Self::Sees { angle, .. } => angle.value.abs() == FRAC_PI_2,
            Self::Ray { .. } => false,
            Self::Circle { .. } | Self::Square { .. } | Self::On(_) => true,
        }
    }
}

impl Statement {
    /// Whether the point counts as placed, and does not follow from the rest of the scene.
    #[must_use]
    pub fn stands(&self) -> bool {
        match self.standing {
            Standing::Stated | Standing::Onto(_) | Standing::AtMeet(_) => true,
            Standing::Hint | Standing::Driven => false,
        }
    }

    /// Every locus: those that are stated, and those onto which the point is brought.
    pub fn all_loci_mut(&mut self) -> impl Iterator<Item = &mut Locus> {
        let settled = match &mut self.standing {
            Standing::Onto(locus) => std::slice::from_mut(locus),
            Standing::AtMeet(loci) => loci.as_mut_slice(),
            Standing::Stated | Standing::Hint | Standing::Driven => &mut [],
        };
        self.loci.iter_mut().chain(settled)
    }

    /// A ray and a distance from one point: the place is laid off, and there is nothing to choose.
    #[must_use]
    pub fn laid_off(&self) -> Option<(PointId, Given, Given)> {
        match self.loci {
            [Locus::Circle { centre, radius }, Locus::Ray { from, direction }]
            | [Locus::Ray { from, direction }, Locus::Circle { centre, radius }]
                if centre == from =>
            {
                Some((from, direction, radius))
            }
            _ => None,
        }
    }
}

impl Mechanism {
    /// What a figure states of the place of a point, if it states anything that is not for others only.
    #[must_use]
    pub fn statement_of(&self, point: PointId) -> Option<&Statement> {
        match self.points.get(point.0)?.place {
            Place::Stated(index) => self.statements.get(index),
            Place::Fixed(_) | Place::Placed(_) | Place::Near(_) | Place::Unknown => None,
        }
    }

    /// Whether the place of a point is given before anything of the mechanism is solved: it is fixed, placed, or
    /// stands where a figure states it.
    #[must_use]
    pub fn is_given(&self, point: PointId) -> bool {
        match self.statement_of(point) {
            Some(statement) => statement.stands(),
            None => self.points.get(point.0).is_some_and(|p| p.place.exact().is_some()),
        }
    }

    /// The mechanism with more room, metres, for every placed point.
    #[must_use]
    pub fn loosened(&self, room: f64) -> Self {
        let mut loose = self.clone();
        for point in &mut loose.points {
            if let Place::Placed(at) = &mut point.place {
                *at = at.map(|coordinate| coordinate.with_room(room));
            }
        }
        loose
    }

    /// The placed points that are known within a room only: by more than what doubles leave open.
    #[must_use]
    pub fn roomy(&self) -> Vec<PointId> {
        let placed = |point: &super::Point| match point.place {
            Place::Placed(at) => Some(at),
            Place::Fixed(_) | Place::Stated(_) | Place::Near(_) | Place::Unknown => None,
        };
        let all = self.points.iter().filter_map(|point| point.place.exact()).flatten();
        let digits = DIGITS * all.map(|coordinate| coordinate.value.abs()).fold(0.0, f64::max);
        let points = self.points.iter().enumerate();
        let roomy =
            points.filter(|(_, point)| placed(point).is_some_and(|at| at.iter().any(|c| c.error > digits)));
        roomy.map(|(index, _)| PointId(index)).collect()
    }

    /// The mechanism as if every placed point stood just where it is stated.
    #[must_use]
    pub fn without_rooms(&self) -> Self {
        let mut exact = self.clone();
        for point in self.roomy() {
            if let Place::Placed(at) = &mut exact.points[point.0].place {
                *at = at.map(|coordinate| Given::read(coordinate.value));
            }
        }
        exact
    }

    /// The mechanism with every stated place as a solver found it: `at` tells the place of the point of a statement.
    #[must_use]
    pub fn with_places(&self, at: impl Fn(&Statement) -> Option<super::GivenPoint>) -> Self {
        let mut standing = Self { statements: Vec::new(), ..self.clone() };
        for point in &mut standing.points {
            let Place::Stated(index) = point.place else { continue };
            let Some(statement) = self.statements.get(index) else { continue };
            point.place = match at(statement) {
                Some(place) if statement.stands() => Place::Placed(place),
                Some(place) => Place::Near(place.map(|c| c.value)),
                None => Place::Unknown,
            };
        }
        standing
    }
}
