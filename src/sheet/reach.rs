//! How far figures on the skeleton reach: instant centres, and velocities carried over by them, lie beside it, often far
//! off. Such a figure has a scale of its own where what it needs is on the paper only so; the skeleton keeps its size.

use std::borrow::Cow;

use kurbo::{Point, Rect};

use super::ink::page;
use super::notation::Notation;
use super::scale;
use super::skeleton::{self, Arrows};
use super::{auxiliary, centres, compose, transfer};
use crate::graphical::construction::{CentrePlace, Construction};
use crate::mechanism::LinkId;
use crate::mechanism::quantity::Dimension;

/// A skeleton that is smaller than this across, mm, shows nothing any more.
pub(super) const LEAST: f64 = 32.0;
/// Nor does one on which something is constructed.
const LEAST_UNDER: f64 = 45.0;

/// A construction as a figure of centres shows it.
pub(super) struct Reach<'a> {
    /// At the scale of the figure.
    pub construction: Cow<'a, Construction>,
    /// What it shows of the plane, on the page; of the lever, which is no figure of the plane, nothing.
    pub window: Rect,
}

impl<'a> Reach<'a> {
    /// Of the figure of instant centres; none where there are none.
    pub fn of_centres(construction: &'a Construction, notation: &Notation<'_>) -> Option<Self> {
        construction.circle.as_ref()?;
        let window = |own: &Construction, skeleton: Rect| match &own.circle {
            Some(circle) => centres::window(circle, construction, skeleton, notation),
            None => Window::bare(skeleton),
        };
        Some(Self::of(construction, notation, (None, LEAST), window))
    }

    /// Of the velocities carried over by a method, by its index; none where there is no such method.
    pub fn of_transfer(
        index: usize,
        construction: &'a Construction,
        notation: &Notation<'_>,
    ) -> Option<Self> {
        let all = transfer::by_method(construction.circle.as_ref()?);
        let base = all.get(index)?.first()?.si_per_mm;
        let window = |own: &Construction, skeleton: Rect| {
            let all = own.circle.as_ref().map(transfer::by_method).unwrap_or_default();
            let own = all.into_iter().nth(index).unwrap_or_default();
            transfer::window(&own, skeleton, notation)
        };
        let with = |arrows: Option<f64>| Self::of(construction, notation, (arrows, LEAST), window);
        // Where its arrows would leave the paper, or the skeleton would have to give way, they have a scale of their own.
        let fits = |own: &Self| {
            let skeleton = skeleton::covers(&own.construction, notation, Arrows::Inputs);
            transfer::fits(own.window, skeleton, notation)
        };
        let mut own = with(None);
        let unit = scale::unit(notation.scene, Dimension::Velocity);
        let coarser =
            scale::coarser(base, unit).take_while(|_| notation.scene.sheet.velocity_scale.is_none());
        for arrows in coarser {
            if fits(&own) {
                break;
            }
            own = with(Some(arrows));
        }
        Some(own)
    }

    /// Of a construction on the skeleton, by its index; none where there is no such construction. What it has on velocities, the
    /// lever, has the scale of these.
    pub fn of_auxiliary(
        index: usize,
        construction: &'a Construction,
        notation: &Notation<'_>,
    ) -> Option<Self> {
        let bare = Self { construction: Cow::Borrowed(construction), window: Rect::ZERO };
        if construction.auxiliary.get(index)?.is_lever() {
            return Some(bare);
        }
        let window = |own: &Construction, skeleton: Rect| match own.auxiliary.get(index) {
            Some(drawing) => auxiliary::window(drawing, skeleton, notation),
            None => Window::bare(skeleton),
        };
        Some(Self::of(construction, notation, (None, LEAST_UNDER), window))
    }

    /// The paper about the window on which names may stand, with room for a caption.
    pub fn paper(&self, notation: &Notation<'_>) -> Rect {
        let (width, height) = compose::free_paper(notation.scene);
        let free = (width.max(self.window.width()), (height - centres::CAPTION).max(self.window.height()));
        Rect::from_center_size(self.window.center(), free)
    }

    /// Whether a centre lies in the plane, but not on the paper of the figure.
    pub fn lies_beyond(&self, links: [LinkId; 2]) -> bool {
        let centre = self.construction.circle.as_ref().and_then(|circle| circle.centre(links));
        match centre.map(|centre| centre.place) {
            Some(CentrePlace::At(at)) => !self.window.contains(page(at)),
            Some(CentrePlace::Toward(_)) | None => false,
        }
    }

    /// At the scale at which it shows most, with arrows of velocities at a scale of their own where one is told, the skeleton no
    /// smaller than so much across, mm.
    fn of(
        construction: &'a Construction,
        notation: &Notation<'_>,
        (arrows, smallest): (Option<f64>, f64),
        window: impl Fn(&Construction, Rect) -> Window,
    ) -> Self {
        let base = construction.space.metres_per_mm;
        let view = |metres_per_mm: f64| {
            let own = if metres_per_mm == base {
                Cow::Borrowed(construction)
            } else {
                Cow::Owned(construction.with_lengths_at(metres_per_mm))
            };
            let own = match arrows {
                Some(si_per_mm) => Cow::Owned(own.with_arrows_at(si_per_mm)),
                None => own,
            };
            let window = window(&own, skeleton::covers(&own, notation, Arrows::Inputs));
            (Self { construction: own, window: window.shows }, window.lost)
        };
        if notation.scene.sheet.length_scale.is_some() {
            return view(base).0;
        }
        let places = construction.space.places.iter().flatten().map(|[x, y]| Point::new(*x, *y));
        let joints = places.map(|at| Rect::from_points(at, at)).reduce(|a, b| a.union(b)).unwrap_or_default();
        chosen(base, (joints.width().max(joints.height()), smallest), view)
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
/// skeleton, metres per mm, which is so many millimetres across there and must stay so large.
pub(super) fn chosen<T>(base: f64, (across, smallest): (f64, f64), view: impl Fn(f64) -> (T, usize)) -> T {
    let (mut best, mut least) = view(base);
    for own in scale::smaller(base) {
        if least == 0 || across * base / own < smallest {
            break;
        }
        let (other, lost) = view(own);
        if lost < least {
            (best, least) = (other, lost);
        }
    }
    best
}
