//! How far figures on the skeleton reach: instant centres, and velocities carried over by them, lie beside it, often far
//! off. Such a figure has a scale of its own where what it needs is on the paper only so; the skeleton keeps its size.

use std::borrow::Cow;

use kurbo::{Point, Rect};

use super::ink::page;
use super::notation::Notation;
use super::scale;
use super::skeleton::{self, Arrows};
use super::{centres, transfer};
use crate::graphical::construction::{CentrePlace, CircleDiagram, Construction};
use crate::mechanism::LinkId;

/// A skeleton that is smaller than this across, mm, shows nothing any more.
const LEAST: f64 = 32.0;

/// A construction as a figure of centres shows it.
pub(super) struct Reach<'a> {
    /// At the scale of the figure.
    pub construction: Cow<'a, Construction>,
    /// What it shows of the plane, on the page.
    pub window: Rect,
}

impl<'a> Reach<'a> {
    /// Of the figure of instant centres; none where there are none.
    pub fn of_centres(construction: &'a Construction, notation: &Notation<'_>) -> Option<Self> {
        Self::of(construction, notation, |circle, skeleton| {
            centres::window(circle, construction, skeleton, notation)
        })
    }

    /// Of the velocities carried over by a method, by its index; none where there is no such method.
    pub fn of_transfer(
        index: usize,
        construction: &'a Construction,
        notation: &Notation<'_>,
    ) -> Option<Self> {
        transfer::by_method(construction.circle.as_ref()?).get(index)?;
        Self::of(construction, notation, |circle, skeleton| {
            let transfers = transfer::by_method(circle).into_iter().nth(index).unwrap_or_default();
            transfer::window(&transfers, skeleton, notation)
        })
    }

    /// Whether a centre lies in the plane, but not on the paper of the figure.
    pub fn lies_beyond(&self, links: [LinkId; 2]) -> bool {
        let centre = self.construction.circle.as_ref().and_then(|circle| circle.centre(links));
        match centre.map(|centre| centre.place) {
            Some(CentrePlace::At(at)) => !self.window.contains(page(at)),
            Some(CentrePlace::Toward(_)) | None => false,
        }
    }

    fn of(
        construction: &'a Construction,
        notation: &Notation<'_>,
        window: impl Fn(&CircleDiagram, Rect) -> Window,
    ) -> Option<Self> {
        construction.circle.as_ref()?;
        let base = construction.space.metres_per_mm;
        let view = |metres_per_mm: f64| {
            let own = if metres_per_mm == base {
                Cow::Borrowed(construction)
            } else {
                Cow::Owned(construction.with_lengths_at(metres_per_mm))
            };
            let skeleton = skeleton::covers(&own, notation, Arrows::Inputs);
            let window =
                own.circle.as_ref().map_or(Window::bare(skeleton), |circle| window(circle, skeleton));
            (Self { construction: own, window: window.shows }, window.lost)
        };
        if notation.scene.sheet.length_scale.is_some() {
            return Some(view(base).0);
        }
        let places = construction.space.places.iter().flatten().map(|[x, y]| Point::new(*x, *y));
        let joints = places.map(|at| Rect::from_points(at, at)).reduce(|a, b| a.union(b)).unwrap_or_default();
        Some(chosen(base, joints.width().max(joints.height()), view))
    }
}

/// What a figure shows of the plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// On the page.
    pub shows: Rect,
    /// How many places it needs that lie beyond.
    pub lost: usize,
}

impl Window {
    /// One that needs nothing beside what is on it.
    pub const fn bare(shows: Rect) -> Self {
        Self { shows, lost: 0 }
    }

    /// With what is needed of the plane.
    pub fn over(shows: Rect, needed: &[Point]) -> Self {
        Self { shows, lost: needed.iter().filter(|at| !shows.contains(**at)).count() }
    }
}

/// The view of the largest scale at which nothing is lost, else that at which least is: the first scale is that of the
/// skeleton, metres per mm, which is so many millimetres across there.
pub(super) fn chosen<T>(base: f64, across: f64, view: impl Fn(f64) -> (T, usize)) -> T {
    let (mut best, mut least) = view(base);
    for own in scale::smaller(base) {
        if least == 0 || across * base / own < LEAST {
            break;
        }
        let (other, lost) = view(own);
        if lost < least {
            (best, least) = (other, lost);
        }
    }
    best
}
