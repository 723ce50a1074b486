//! Slider-crank loops for the structure report: transmission and pressure angle, stroke, and the dead positions
//! in closed form, whichever of crank and slider drives.

use std::f64::consts::PI;

use super::report::{DeadPosition, InLine, Places, pivot, span, turn_from};
use super::structure::{GroupKind, Structure};
use super::{Direction, Guide, GuidePoint, LinkId, Mechanism, Path, PointId, Rider, Slide};

/// A crank about a fixed pivot, a rod, and the rod's end on a straight guide of the frame.
#[derive(Debug, Clone, PartialEq)]
pub struct SliderCrank {
    /// Numbers of crank and rod.
    pub links: [u32; 2],
    /// Names of the crank's pivot, the crank pin and the pin on the guide.
    pub joints: [String; 3],
    /// Crank, rod, and distance of the guide from the pivot (not negative), metres.
    pub lengths: [f64; 3],
    /// The slider drives the crank.
    pub from_slider: bool,
    /// Angle by which the rod's force is judged, radians in [0, π/2]: between the rod and the normal of the
    /// guide where the crank drives, between rod and crank where the slider does.
    pub transmission: Option<f64>,
    /// How far the slider goes, metres, where the crank can turn fully.
    pub stroke: Option<f64>,
    /// Dead positions, the nearest first.
    pub dead: Vec<DeadPosition>,
}

impl SliderCrank {
    /// Pressure angle: what the transmission angle lacks of a right angle.
    #[must_use]
    pub fn pressure(&self) -> Option<f64> {
        self.transmission.map(|t| PI / 2.0 - t)
    }
}

/// Every slider-crank loop of a mechanism.
pub(super) fn slider_cranks(
    mechanism: &Mechanism,
    structure: &Structure,
    places: &Places<'_>,
) -> Vec<SliderCrank> {
    let mut found = Vec::new();
    for group in &structure.groups {
        match group.kind {
            GroupKind::Rrp { rod, base, pin, slide, .. } => {
                let crank = mechanism.point(base).links.iter().copied().find(|&l| {
                    l != rod && l != LinkId::FRAME && pivot(mechanism, l).is_some_and(|p| p != base)
                });
                found.extend(
                    crank.and_then(|crank| {
                        loop_of(mechanism, [crank, rod], [base, pin], (slide, false), places)
                    }),
                );
            }
            GroupKind::Rrr { links, bases, pin } => {
                for (rod, crank) in [(0, 1), (1, 0)] {
                    let rides = |slide: &Slide| matches!(slide.rider, Rider::Pin { point, .. } if point == bases[rod]);
                    let slide = mechanism.slides.iter().position(rides);
                    let ends = [pin, bases[rod]];
                    found.extend(slide.filter(|_| mechanism.is_fixed(bases[crank])).and_then(|slide| {
                        loop_of(mechanism, [links[crank], links[rod]], ends, (slide, true), places)
                    }));
                }
            }
            _ => {}
        }
    }
    found
}

fn loop_of(
    mechanism: &Mechanism,
    [crank, rod]: [LinkId; 2],
    [start, pin]: [PointId; 2],
    (slide, from_slider): (usize, bool),
    places: &Places<'_>,
) -> Option<SliderCrank> {
    let Slide { rider, guide } = mechanism.slides[slide];
    if guide.link != LinkId::FRAME {
        return None;
    }
    let from = pivot(mechanism, crank)?;
    let (mut through, along) = line_of(mechanism, &guide)?;
    // A pin on a riding link runs on a parallel to the guide, through where it stands.
    if matches!(rider, Rider::Link { .. }) {
        through = places(pin)?;
    }
    let at =
        |p: PointId| mechanism.point(p).place.exact().map(|at| at.map(|x| x.value)).or_else(|| places(p));
    let pivot_at = at(from)?;
    let normal = [-along[1], along[0]];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
    let offset = dot(minus(through, pivot_at), normal);
    let r = span(mechanism, crank, from, start, places)?;
    let l = span(mechanism, rod, start, pin, places)?;
    let (o, a, b) = (places(from), places(start), places(pin));
    let now = o.zip(a).map(|(o, a)| minus(a, o)).map(|v| libm::atan2(v[1], v[0]));
    let side = a.zip(b).map(|(a, b)| dot(minus(b, a), along));
    let transmission = o.zip(a).zip(b).map(|((o, a), b)| {
        let rod = minus(b, a);
        let against = if from_slider { minus(a, o) } else { normal };
        let cross = rod[0] * against[1] - rod[1] * against[0];
        libm::atan2(cross.abs(), dot(rod, against).abs())
    });
    let turns_fully = l > r + offset.abs();
    let along_angle = libm::atan2(along[1], along[0]);
    let mut dead = Vec::new();
    let mut add = |links: InLine, extended: bool, angle: f64, side: f64| {
        let angle = angle.rem_euclid(2.0 * PI);
        let one = DeadPosition { links, extended, angle, turn: turn_from(now, angle), side };
        if !dead.contains(&one) {
            dead.push(one);
        }
    };
    let reach = |distance: f64| {
        let square = (distance - offset) * (distance + offset);
        (square >= 0.0).then(|| libm::sqrt(square))
    };
    for (extended, distance) in [(true, l + r), (false, (l - r).abs())] {
        for sign in [1.0, -1.0] {
            // Where the crank turns fully the slider stays on its side of the pivot.
            let other_side = turns_fully && side.is_some_and(|side| side * sign < 0.0);
            if let (Some(x), false) = (reach(distance), other_side) {
                let toward = along_angle + libm::atan2(offset, sign * x);
                let away = if !extended && l > r { PI } else { 0.0 };
                add(InLine::DriverAndCoupler, extended, toward + away, sign);
            }
        }
    }
    for sign in [1.0, -1.0] {
        let sine = (offset + sign * l) / r;
        if sine.abs() <= 1.0 {
            let angle = libm::asin(sine);
            add(InLine::CouplerSquareToGuide, true, along_angle + angle, sign);
            add(InLine::CouplerSquareToGuide, true, along_angle + PI - angle, sign);
        }
    }
    dead.sort_by(|a, b| a.turn.abs().total_cmp(&b.turn.abs()));
    let stroke = reach(l + r).zip(reach(l - r)).map(|(far, near)| far - near).filter(|_| turns_fully);
    Some(SliderCrank {
        links: [crank, rod].map(|id| mechanism.link(id).number),
        joints: [from, start, pin].map(|p| mechanism.point(p).name.clone()),
        lengths: [r, l, offset.abs()],
        from_slider,
        transmission,
        stroke,
        dead,
    })
}

/// A point of a straight guide of the frame, and its direction.
fn line_of(mechanism: &Mechanism, guide: &Guide) -> Option<([f64; 2], [f64; 2])> {
    let Path::Straight { through, direction, turned, offset } = guide.path else { return None };
    let exact = |p: PointId| mechanism.point(p).place.exact().map(|at| at.map(|x| x.value));
    let start = match through {
        GuidePoint::Point(p) => exact(p)?,
        GuidePoint::Own(at) => at.map(|x| x.value),
    };
    let angle = match direction {
        Direction::Angle(angle) => angle.value,
        Direction::Toward(p) => {
            let end = exact(p)?;
            libm::atan2(end[1] - start[1], end[0] - start[0])
        }
    } + turned.value;
    let along = [libm::cos(angle), libm::sin(angle)];
    let through = [start[0] - offset.value * along[1], start[1] + offset.value * along[0]];
    Some((through, along))
}

#[cfg(test)]
mod tests {
    use super::super::report::{InLine, Report, report};
    use crate::scene;

    fn report_of(slider: &str, links: &str, input: &str) -> Report {
        let text = format!(
            r#"{{ "fixed": {{ "O": [0, 0] }}, "links": {{ {links} }}, "slides": [{slider}],
                 "near": {{ "A": [0, 1], "B": [3, 0.5] }}, "input": {input} }}"#
        );
        let scene = scene::read(&text, "test").unwrap_or_else(|error| panic!("{error}"));
        // Crank at 90°, rod down to the guide at y = 0.5.
        let places = |p: crate::mechanism::PointId| match scene.mechanism.point(p).name.as_str() {
            "A" => Some([0.0, 1.0]),
            "B" => Some([libm::sqrt(9.0 - 0.25), 0.5]),
            _ => Some([0.0, 0.0]),
        };
        report(&scene.mechanism, &places)
    }

    const LINKS: &str =
        r#""2": { "joins": ["O", "A"], "length": 1 }, "3": { "joins": ["A", "B"], "length": 3 }"#;
    const SLIDER: &str =
        r#"{ "pin": "B", "block": 4, "on": { "link": 1, "through": [7, 0.5], "angle": 0 } }"#;

    #[test]
    fn an_offset_slider_crank_has_its_limits_where_crank_and_rod_are_in_line() {
        let r = report_of(SLIDER, LINKS, r#"{ "link": 2, "angle": 90, "omega": 1 }"#);
        let [loop_] = r.slider_cranks.as_slice() else { panic!("{:?}", r.slider_cranks) };
        assert_eq!(loop_.lengths, [1.0, 3.0, 0.5]);
        assert_eq!((loop_.links, loop_.from_slider), ([2, 3], false));
        // sin φ = e/(l + r) and e/(l − r); stroke √((l+r)² − e²) − √((l−r)² − e²).
        let expected = [(true, libm::asin(0.5 / 4.0)), (false, libm::asin(0.5 / 2.0) + std::f64::consts::PI)];
        assert_eq!(loop_.dead.len(), 2);
        for (extended, angle) in expected {
            let found = loop_.dead.iter().any(|d| {
                d.links == InLine::DriverAndCoupler
                    && d.extended == extended
                    && (d.angle - angle).abs() < 1e-14
            });
            assert!(found, "{angle}: {:?}", loop_.dead);
        }
        let stroke = libm::sqrt(16.0 - 0.25) - libm::sqrt(4.0 - 0.25);
        assert!((loop_.stroke.unwrap() - stroke).abs() < 1e-14);
        // The rod falls by half a unit on three.
        assert!((loop_.pressure().unwrap() - libm::asin(0.5 / 3.0)).abs() < 1e-14);
    }

    #[test]
    fn a_slider_that_drives_meets_the_same_positions_as_dead_centres() {
        let r = report_of(SLIDER, LINKS, r#"{ "slide": "B", "at": -4, "velocity": 1 }"#);
        let [loop_] = r.slider_cranks.as_slice() else { panic!("{:?}", r.slider_cranks) };
        assert!(loop_.from_slider);
        assert!(loop_.dead.iter().all(|d| d.links == InLine::DriverAndCoupler));
        // Rod against the upright crank.
        assert!((loop_.transmission.unwrap() - libm::acos(0.5 / 3.0)).abs() < 1e-14);
    }

    #[test]
    fn a_short_rod_stops_the_crank_where_it_stands_square_to_the_guide() {
        let links = LINKS.replace("\"length\": 3", "\"length\": 1.2");
        let r = report_of(SLIDER, &links, r#"{ "link": 2, "angle": 90, "omega": 1 }"#);
        let loop_ = &r.slider_cranks[0];
        assert_eq!(loop_.stroke, None);
        // sin θ = e − l = −0.7.
        for angle in [2.0 * std::f64::consts::PI - libm::asin(0.7), std::f64::consts::PI + libm::asin(0.7)] {
            let found = loop_
                .dead
                .iter()
                .any(|d| d.links == InLine::CouplerSquareToGuide && (d.angle - angle).abs() < 1e-14);
            assert!(found, "{angle}: {:?}", loop_.dead);
        }
    }
}
