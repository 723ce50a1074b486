//! Round scales: 1, 2, 2.5, 5 × 10ⁿ.

use super::compose::free_paper;
use crate::graphical::auxiliary::AuxiliaryDrawing;
use crate::graphical::construction::Construction;
use crate::graphical::{Extents, Scales};
use crate::mechanism::{Mechanism, PointId, Roll};
use crate::scene::Scene;

/// The round steps within a decade.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// Room for the skeleton's geometry with the result table beside it, width and height in mm.
pub const SKELETON: (f64, f64) = (92.0, 70.0);
/// Room for a long and low skeleton that has the row to itself.
pub const LONG_SKELETON: (f64, f64) = (150.0, 48.0);
/// Room for a construction on the skeleton with its named points, inside the names.
pub const AUXILIARY: (f64, f64) = (140.0, 130.0);
/// Room for a polygon that shares its row with another.
pub const HALF_POLYGON: (f64, f64) = (73.0, 78.0);
/// Room for the only polygon of a sheet, and for arrows on the skeleton.
pub const LONE_POLYGON: (f64, f64) = (150.0, 78.0);
/// Room for a polygon that has the row to itself.
pub const POLYGON: (f64, f64) = (150.0, 108.0);
/// Room for a polygon that has a page to itself.
pub const PAGE_POLYGON: (f64, f64) = (158.0, 205.0);
/// Room for a skeleton that has the row to itself.
pub const ROW_SKELETON: (f64, f64) = (150.0, 104.0);
/// Room for a skeleton that has a page to itself.
pub const PAGE_SKELETON: (f64, f64) = (155.0, 180.0);
/// Points of a polygon that are not one stand so far apart on paper, mm, where the paper suffices.
pub const APART: f64 = 3.0;
/// Joints of a skeleton: a shorter link is hidden by the circles of its own pins.
const JOINTS_APART: f64 = 12.0;
/// What a named vector or point needs of a polygon's area, mm², if its name is to stand beside it.
const PER_NAME: f64 = 110.0;
/// Width that two polygons side by side have, with their names, and at least for their captions.
const ROW: f64 = 168.0;
/// Width that the names beside a polygon need.
const NAMES: f64 = 13.0;
/// Width of a caption.
const CAPTION: f64 = 70.0;

/// Room for the skeleton of a question with its dimension lines, width and height in mm.
pub const QUESTION: (f64, f64) = (112.0, 96.0);

/// The scales of a question: as for a solution, but the skeleton has the row to itself.
#[must_use]
pub fn for_question(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let free = (QUESTION.0 * wide, QUESTION.1 * high);
    let stated = scene.sheet.length_scale.map(|ratio| ratio / 1000.0);
    let length = stated.or(choose_length(w, h, free)).unwrap_or(0.001);
    Scales { length, ..for_scene(scene, extents) }
}

/// Room for a diagram beside the words of a step, width and height in mm.
pub const STEP: (f64, f64) = (66.0, 62.0);

/// The scales of a sheet that shows the steps one by one: each diagram fits beside its words.
#[must_use]
pub fn for_steps(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let free = (STEP.0 * wide, STEP.1 * high);
    let (length, time) = (scene.units.length.si, scene.units.time.si);
    let fit = |[w, h]: [f64; 2], unit: f64| choose_for(w, h, free, unit);
    let rate = length / time;
    let stated = &scene.sheet;
    Scales {
        length: stated
            .length_scale
            .map(|ratio| ratio / 1000.0)
            .or(choose_length(w, h, free))
            .unwrap_or(0.001),
        velocity: stated.velocity_scale.or(fit(extents.velocity, rate)).unwrap_or(rate),
        acceleration: stated
            .acceleration_scale
            .or(fit(extents.acceleration, rate / time))
            .unwrap_or(rate / time),
    }
}

/// How much wider and higher than those of upright A4 the panels are.
fn stretch(scene: &Scene) -> (f64, f64) {
    let (width, height) = free_paper(scene);
    let (wide, high) = (width / 176.0, height / 263.0);
    (wide, high.max((wide * high).sqrt()).min(height / 120.0))
}

/// The scales of a scene: those that it states, else round ones by which the diagrams fill their panels. A diagram whose
/// points crowd has a row, then a page to itself, and so has one for which the pages have room.
#[must_use]
pub fn for_scene(scene: &Scene, extents: Extents) -> Scales {
    let length = scene.units.length.si;
    let stretch = stretch(scene);
    let time = scene.units.time.si;
    let units = [length / time, length / (time * time)];
    let stated = &scene.sheet;
    let stated_lengths =
        [stated.length_scale.map(|ratio| ratio / 1000.0), stated.velocity_scale, stated.acceleration_scale];
    let choices = Choices {
        sizes: [
            with_wheels(&scene.mechanism, extents.positions, extents.rims),
            extents.velocity,
            extents.acceleration,
        ],
        units,
        stretch,
        paper: free_paper(scene),
        stated: stated_lengths,
        extents: &extents,
        asked: scene.mechanism.asked.len(),
    };
    let [skeleton, velocity, acceleration] = choices.best();
    Scales {
        length: skeleton.unwrap_or(0.001),
        velocity: velocity.unwrap_or(units[0]),
        acceleration: acceleration.unwrap_or(units[1]),
    }
}

/// How much room a diagram has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Room {
    Shared,
    Row,
    Page,
}

impl Room {
    const ALL: [Self; 3] = [Self::Shared, Self::Row, Self::Page];
}

/// Scales, SI per mm, of the skeleton, the velocity and the acceleration polygon; none where nothing has a size.
type Three = [Option<f64>; 3];

/// What the scales of the three diagrams are chosen by.
struct Choices<'a> {
    /// Width and height of skeleton and polygons, SI.
    sizes: [[f64; 2]; 3],
    units: [f64; 2],
    stretch: (f64, f64),
    /// Within the margins, mm.
    paper: (f64, f64),
    stated: Three,
    extents: &'a Extents,
    /// How many results there are.
    asked: usize,
}

impl Choices<'_> {
    /// The scales at which what crowds has room, and beyond these the largest for which the sheet needs no further page.
    fn best(&self) -> Three {
        /// Estimates of heights err by about so much, mm.
        const SPARE: f64 = 22.0;
        let mut rooms = [Room::Shared; 3];
        for i in 0..3 {
            let mut least = self.crowding(i, self.scales(rooms)[i]);
            for room in [Room::Row, Room::Page] {
                let mut wider = rooms;
                wider[i] = room;
                let crowding = self.crowding(i, self.scales(wider)[i]);
                if crowding < least {
                    (rooms, least) = (wider, crowding);
                }
            }
        }
        let pages = self.pages(self.scales(rooms), 0.0);
        let mut best = (0.0, self.scales(rooms));
        for skeleton in Room::ALL {
            for velocity in Room::ALL {
                for acceleration in Room::ALL {
                    let wider = [skeleton, velocity, acceleration];
                    let grown = wider.iter().zip(&rooms).all(|(a, b)| a >= b);
                    // To fill a page a row is enough.
                    let modest = wider.iter().zip(&rooms).all(|(a, b)| *a <= Room::Row.max(*b));
                    let scales = self.scales(wider);
                    if !(grown && modest) || self.pages(scales, SPARE) > pages {
                        continue;
                    }
                    let gain: f64 = (0..3).map(|i| self.gain(i, scales[i])).sum();
                    if gain > best.0 {
                        best = (gain, scales);
                    }
                }
            }
        }
        best.1
    }

    /// How large a diagram is to the eye: what fills a quarter of a page is large enough.
    fn gain(&self, i: usize, scale: Option<f64>) -> f64 {
        let Some(scale) = scale else { return 0.0 };
        let [w, h] = self.sizes[i].map(|side| side / scale);
        (w * h).sqrt().max(0.6 * w.max(h)).min(115.0)
    }

    fn scales(&self, rooms: [Room; 3]) -> Three {
        let stretched = |room: (f64, f64)| (room.0 * self.stretch.0, room.1 * self.stretch.1);
        // Never higher than the page, whatever its form.
        let below = |room: (f64, f64)| (room.0, room.1.min(self.paper.1 - 45.0));
        let [w, h] = self.sizes[0];
        let fit = |room| choose_length(w, h, below(stretched(room)));
        let skeleton = match rooms[0] {
            Room::Shared => fit(SKELETON).zip(fit(LONG_SKELETON)).map(|(a, b)| a.min(b)),
            Room::Row => fit(ROW_SKELETON),
            Room::Page => fit(PAGE_SKELETON),
        };
        let [mut velocity, mut acceleration] =
            polygons([self.sizes[1], self.sizes[2]], self.units, self.stretch);
        for (i, own) in [&mut velocity, &mut acceleration].into_iter().enumerate() {
            let [w, h] = self.sizes[i + 1];
            let room = match rooms[i + 1] {
                // Arrows on the skeleton are no diagram.
                _ if self.extents.images[i].is_empty() => continue,
                Room::Shared => continue,
                Room::Row => POLYGON,
                Room::Page => PAGE_POLYGON,
            };
            let wider = choose_for(w, h, below(stretched(room)), self.units[i]);
            *own = own.zip(wider).map(|(a, b)| a.min(b));
        }
        let [length, v, a] = self.stated;
        [length.or(skeleton), v.or(velocity), a.or(acceleration)]
    }

    /// How many points of a diagram stand too near to others at this scale, and how much area its names lack.
    fn crowding(&self, i: usize, scale: Option<f64>) -> usize {
        let Some(scale) = scale else { return 0 };
        let (points, apart): (&[[f64; 2]], f64) = match i {
            0 => (&self.extents.joints, JOINTS_APART),
            _ => (&self.extents.images[i - 1], APART),
        };
        let near = too_near(points, apart * scale);
        let names = if i == 0 { 0 } else { self.extents.vectors[i - 1] + points.len() };
        let [w, h] = self.sizes[i].map(|side| side / scale);
        // A flat polygon is named along its sides.
        let area = (w + 16.0) * (h + 16.0);
        let lacking = PER_NAME * names as f64 - area;
        near + (lacking / PER_NAME).max(0.0) as usize
    }

    /// About how many pages the sheet needs at these scales, with so much blank to spare, mm.
    fn pages(&self, scales: Three, spare: f64) -> usize {
        const HEADING: f64 = 28.0;
        /// What names and caption add to the height of a diagram, and to that of a skeleton with its supports.
        const AROUND: [f64; 2] = [25.0, 31.0];
        /// Height of a row of the result table, and of its head and end.
        const RESULT: [f64; 2] = [5.9, 9.0];
        const TALLEST_BESIDE: f64 = 112.0;
        /// Width of the result table, and what stands about a skeleton.
        const BESIDE: [f64; 2] = [62.0, 34.0];
        let free = self.paper.1 - 6.0;
        let drawn = |i: &usize| *i == 0 || !self.extents.images[i - 1].is_empty();
        let size = |i: usize| {
            let scale = scales[i].filter(|_| drawn(&i))?;
            Some(self.sizes[i].map(|side| side / scale))
        };
        let mut rows: Vec<f64> = Vec::new();
        let [w, h] = size(0).unwrap_or_default();
        let table = RESULT[0] * self.asked as f64 + RESULT[1];
        let beside = w + BESIDE[1] + BESIDE[0] <= self.paper.0 && table <= TALLEST_BESIDE;
        rows.push(if beside { f64::max(h + AROUND[1], table + 6.0) } else { h + AROUND[1] });
        let caption = |w: f64| f64::max(w + 2.0 * NAMES, CAPTION);
        match [size(1), size(2)] {
            [Some([w, h]), Some([ww, hh])] if caption(w) + caption(ww) <= self.paper.0 => {
                rows.push(h.max(hh) + AROUND[0]);
            }
            polygons => rows.extend(polygons.into_iter().flatten().map(|[_, h]| h + AROUND[0])),
        }
        if self.extents.circle {
            rows.push(h + AROUND[1] + 40.0);
            rows.push(110.0);
        }
        if !beside {
            rows.push(RESULT[0] * (self.asked as f64 / 2.0).ceil() + RESULT[1] + 8.0);
        }
        let told = self.extents.told;
        let lines = 1.2 * told.acts as f64 * 4.9 + 18.0 * told.equations as f64 + 8.5 * told.steps as f64;
        // In two columns, of which the wider ones hold more in a line.
        let mut text = lines * (176.0 / self.paper.0).min(1.0) / 2.0 + spare;
        let (mut pages, mut y) = (1, HEADING);
        for row in rows {
            if y + row > free {
                // A small rest of a page stays blank.
                text -= if free - y > 28.0 { free - y - 8.0 } else { 0.0 };
                pages += 1;
                y = 7.0;
            }
            y += row;
        }
        text = text.max(0.0);
        if y + text > free {
            pages += ((y + text - free) / (free - 7.0)).ceil() as usize;
        }
        pages
    }
}

/// How many points have another nearer than `least` that is not the same point.
fn too_near(points: &[[f64; 2]], least: f64) -> usize {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let same = least * 1e-3;
    let mut near = vec![false; sorted.len()];
    for i in 0..sorted.len() {
        for j in i + 1..sorted.len() {
            if sorted[j][0] - sorted[i][0] >= least {
                break;
            }
            let apart = libm::hypot(sorted[j][0] - sorted[i][0], sorted[j][1] - sorted[i][1]);
            if apart > same && apart < least {
                (near[i], near[j]) = (true, true);
            }
        }
    }
    near.into_iter().filter(|near| *near).count()
}

/// A smaller length scale, metres per millimetre, at which a construction on the skeleton finds room with all its
/// named points; `None` where it has room, or where the skeleton would become too small to read.
#[must_use]
pub fn for_auxiliary(construction: &Construction, drawing: &AuxiliaryDrawing) -> Option<f64> {
    /// The skeleton is not shrunk by more than this.
    const MOST: f64 = 4.0;
    let named = drawing.points.iter().map(|p| p.at);
    let all: Vec<[f64; 2]> = named.chain(construction.space.places.iter().flatten().copied()).collect();
    let extent = |axis: usize| {
        let least = all.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let most = all.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        most - least
    };
    let needed = f64::max(extent(0) / AUXILIARY.0, extent(1) / AUXILIARY.1);
    if !(needed > 1.0 && needed <= MOST) {
        return None;
    }
    choose_length(
        extent(0) * construction.space.metres_per_mm,
        extent(1) * construction.space.metres_per_mm,
        AUXILIARY,
    )
}

/// Width and height of a skeleton with its pitch circles: those about placed centres have room in it, those about moving
/// ones may reach a little beyond it, for there is nothing to read at a rim.
fn with_wheels(mechanism: &Mechanism, [w, h]: [f64; 2], rims: [f64; 2]) -> [f64; 2] {
    const BEYOND: f64 = 1.25;
    let place = |p: PointId| mechanism.points.get(p.0)?.place.exact().map(|at| at.map(|x| x.value));
    let mut wheels: Vec<([f64; 2], f64)> = Vec::new();
    for roll in &mechanism.rolls {
        let circles = match roll {
            Roll::Circles { centres, radii, .. } => [0, 1].map(|i| (centres[i], radii[i].value)).to_vec(),
            Roll::Line { centre, radius, .. } => vec![(*centre, radius.value)],
        };
        wheels.extend(circles.into_iter().filter_map(|(centre, radius)| Some((place(centre)?, radius))));
    }
    let grown = |axis: usize, size: f64| {
        let least = wheels.iter().map(|(at, r)| at[axis] - r).fold(f64::INFINITY, f64::min);
        let most = wheels.iter().map(|(at, r)| at[axis] + r).fold(f64::NEG_INFINITY, f64::max);
        size.max(most - least).max(rims[axis] / BEYOND)
    };
    [grown(0, w), grown(1, h)]
}

/// Scales of both polygons: each fits into its half of a row, and a narrow one leaves its room to the
/// other.
fn polygons(sizes: [[f64; 2]; 2], units: [f64; 2], (wide, high): (f64, f64)) -> [Option<f64>; 2] {
    let stretched = |room: (f64, f64)| (room.0 * wide, room.1 * high);
    let fit = |i: usize, free| choose_for(sizes[i][0], sizes[i][1], free, units[i]);
    let halves = [fit(0, stretched(HALF_POLYGON)), fit(1, stretched(HALF_POLYGON))];
    let [Some(velocity), Some(acceleration)] = halves else {
        return [0, 1].map(|i| fit(i, stretched(LONE_POLYGON)));
    };
    let wider = |taken: f64| (ROW * wide - f64::max(taken + NAMES, CAPTION) - NAMES, POLYGON.1 * high);
    let acceleration = fit(1, wider(sizes[0][0] / velocity)).map_or(acceleration, |s| s.min(acceleration));
    let velocity = fit(0, wider(sizes[1][0] / acceleration)).map_or(velocity, |s| s.min(velocity));
    [Some(velocity), Some(acceleration)]
}

/// The smallest round number (1, 2, 2.5, 5 × 10ⁿ) that is not below `least`; `None` unless `least` is
/// positive and finite.
#[must_use]
pub fn round_up(least: f64) -> Option<f64> {
    if !(least > 0.0 && least.is_finite()) {
        return None;
    }
    let mut exponent = libm::floor(libm::log10(least)) as i32 - 1;
    // A product that misses the round number by its last bit must not cost a whole step.
    let enough = least * (1.0 - 1e-12);
    loop {
        for step in STEPS {
            let k = shifted(step, exponent);
            if k >= enough && k > 0.0 {
                return k.is_finite().then_some(k);
            }
        }
        exponent += 1;
        if exponent > 308 {
            return None;
        }
    }
}

/// `step × 10^exponent`, correctly rounded: decimal text is, and so is one operation on two exact numbers.
fn shifted(step: f64, exponent: i32) -> f64 {
    const POWERS: [f64; 23] = [
        1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17,
        1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    // Of the steps those of one and more are exact, and the powers up to the 22nd.
    if let Some(power) = POWERS.get(exponent.unsigned_abs() as usize).filter(|_| step >= 1.0) {
        return if exponent < 0 { step / power } else { step * power };
    }
    format!("{step}e{exponent}").parse().unwrap_or(0.0)
}

/// SI units per millimetre of paper such that `max_si` fits into `free_mm` and one *centimetre* of paper
/// is a round number of the scene's units; `unit_si` is how many SI units one of those is.
#[must_use]
pub fn choose(max_si: f64, free_mm: f64, unit_si: f64) -> Option<f64> {
    let per_cm = round_up(max_si / unit_si / (free_mm / 10.0))?;
    let per_mm = per_cm * unit_si / 10.0;
    (per_mm > 0.0 && per_mm.is_finite()).then_some(per_mm)
}

/// The same for what is `width_si` wide and `height_si` high and must fit into a panel.
#[must_use]
pub fn choose_for(width_si: f64, height_si: f64, free_mm: (f64, f64), unit_si: f64) -> Option<f64> {
    let tall = height_si / free_mm.1 * free_mm.0;
    choose(width_si.max(tall), free_mm.0, unit_si)
}

/// Metres per millimetre of paper such that what is `width_m` wide and `height_m` high fits into a panel
/// and the ratio is 1 : N with a round N (or N : 1 for what is smaller than its drawing).
#[must_use]
pub fn choose_length(width_m: f64, height_m: f64, free_mm: (f64, f64)) -> Option<f64> {
    let needed = (width_m / free_mm.0).max(height_m / free_mm.1) * 1000.0;
    if needed >= 1.0 {
        return Some(round_up(needed)? / 1000.0);
    }
    // Enlarged: N : 1 with the largest round N that still fits.
    let mut enlarge = round_up(1.0 / needed)?;
    if enlarge * needed > 1.0 + 1e-12 {
        let below = STEPS.iter().rev().map(|s| s / 10.0).chain(STEPS.iter().rev().copied());
        let exponent = libm::floor(libm::log10(enlarge)) as i32;
        let mut fitting = 0.0_f64;
        for step in below {
            for e in [exponent, exponent + 1] {
                let n = shifted(step, e);
                if n * needed <= 1.0 + 1e-12 {
                    fitting = fitting.max(n);
                }
            }
        }
        enlarge = fitting;
    }
    (enlarge > 0.0).then(|| 1.0 / (1000.0 * enlarge))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_round_number() {
        for (least, round) in [
            (1.0, 1.0),
            (1.01, 2.0),
            (2.0, 2.0),
            (2.1, 2.5),
            (0.3, 0.5),
            (51.0, 100.0),
            (1e-300, 1e-300),
            (7.3e17, 1e18),
        ] {
            assert_eq!(round_up(least), Some(round));
        }
        for none in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::MAX] {
            assert_eq!(round_up(none), None);
        }
    }

    #[test]
    fn the_book_s_scales() {
        // Problem 3-1: V_D = 1.78 m/s fits into 40 mm at 50 cm/s ≡ 1 cm.
        let k = choose(1.782_49, 40.0, 0.01).unwrap();
        assert!((k - 0.05).abs() < 1e-15, "{k}");
        // A 525 by 581 mm mechanism fits into 105 × 66 mm at 1 : 10.
        let k = choose_length(0.525, 0.581, (105.0, 66.0)).unwrap();
        assert!((k - 0.01).abs() < 1e-15, "{k}");
        // A 3 by 2 mm mechanism is enlarged 25 : 1.
        let k = choose_length(0.003, 0.002, (105.0, 66.0)).unwrap();
        assert!((k * 1000.0 * 25.0 - 1.0).abs() < 1e-12, "{k}");
    }
}
