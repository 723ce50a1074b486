//! The picture of speed against accuracy: error over time, both logarithmic; each setting a stroke from its
//! median error to its greatest.

use kurbo::{Point, Rect, Vec2};

use super::figure::{Figure, Group, Mark, Pen, Shape};
use super::ink::{FINE, SMALL, THIN, dot};
use super::labels::{self, Request, Site};
use super::rich::Rich;
use crate::tradeoff::{Outcome, Setting, Tradeoff};

/// The page, mm.
const PAGE: (f64, f64) = (190.0, 130.0);
/// The plot on it: left, top, right, bottom.
const PLOT: (f64, f64, f64, f64) = (22.0, 22.0, 182.0, 112.0);
/// An error below this is drawn here: a double-double's last digit.
const LEAST_ERROR: f64 = 1e-34;
/// Size of tick labels.
const TICK: f64 = 2.6;

/// Exponents of ten around some numbers.
fn decades(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(libm::log10(x)), high.max(libm::log10(x)))
    });
    if low <= high { [low.floor(), (high.floor() + 1.0).max(low.floor() + 1.0)] } else { [0.0, 1.0] }
}

fn power(exponent: f64) -> Rich {
    let text = if exponent < 0.0 { format!("\u{2212}{}", -exponent) } else { exponent.to_string() };
    Rich::upright("10").sup(&text)
}

/// Error over time for every setting that has both.
#[must_use]
pub fn of_tradeoff(tradeoff: &Tradeoff) -> Figure {
    let shown: Vec<(&Outcome, [f64; 3], [f64; 2])> = tradeoff
        .outcomes
        .iter()
        .filter_map(|o| {
            let (seconds, errors) = (o.seconds?, o.errors?);
            let micro = [seconds.median, seconds.low, seconds.high].map(|s| s * 1e6);
            Some((o, micro, [errors.median, errors.most].map(|e| e.max(LEAST_ERROR))))
        })
        .collect();
    let x = decades(shown.iter().flat_map(|s| s.1));
    let y = decades(shown.iter().flat_map(|s| s.2));
    let plot = Rect::new(PLOT.0, PLOT.1, PLOT.2, PLOT.3);
    let map = |time: f64, error: f64| {
        let part = |v: f64, [low, high]: [f64; 2]| (libm::log10(v) - low) / (high - low);
        Point::new(plot.x0 + part(time, x) * plot.width(), plot.y1 - part(error, y) * plot.height())
    };
    let mut root = Group::new("tradeoff");
    let title = "Error against time".to_owned();
    Rich::bold(&title).set(5.0).put(&mut root, Point::new(10.0, 12.0), "title");
    let axes = axes(plot, x, y);
    root.group(axes);

    let mut points = Group::new("settings");
    let mut requests = Vec::new();
    for (outcome, [median, low, high], [usual, most]) in &shown {
        let at = map(*median, *usual);
        let mut group = Group::new("setting").data("name", outcome.setting.name());
        group.mark(stroke(at, map(*median, *most)));
        group.mark(stroke(map(*low, *usual), map(*high, *usual)));
        group.mark(match outcome.setting {
            Setting::Drawn(_) => dot(at, 1.1),
            _ => Mark::outlined(
                Shape::Circle { centre: at, radius: 0.9 },
                Pen::solid(THIN),
                super::figure::Tone::Paper,
            ),
        });
        points.group(group);
        let mut request = Request::new(
            Rich::upright(outcome.setting.name()),
            TICK,
            Site::Around { at, radius: 1.2, toward: Some(0.0) },
            "name",
        );
        request.leader = true;
        requests.push(request);
    }
    let names = labels::place(&points, &requests, Some(plot.inflate(-0.5, -0.5)));
    root.group(points);
    root.group(names);
    let foot = "filled: with bounds and strokes; each stroke goes from the median error to the greatest, across it the \
                time of one pass in ten to nine in ten";
    Rich::upright(foot).set(TICK).put(&mut root, Point::new(10.0, PAGE.1 - 4.0), "caption");
    Figure {
        width: PAGE.0,
        height: PAGE.1,
        title,
        description: "Error of the asked quantities over the time that they take, by setting".to_owned(),
        language: "en",
        root,
    }
}

fn stroke(from: Point, to: Point) -> Mark {
    Mark::stroke(Shape::Line(from, to), Pen::solid(THIN)).class("spread")
}

/// The frame with a line and a number for each decade; fewer numbers where there are many.
fn axes(plot: Rect, x: [f64; 2], y: [f64; 2]) -> Group {
    let mut group = Group::new("axes");
    let corners =
        vec![Point::new(plot.x0, plot.y0), Point::new(plot.x0, plot.y1), Point::new(plot.x1, plot.y1)];
    group.mark(Mark::stroke(Shape::Polyline(corners), Pen::solid(THIN)).class("axis"));
    let exponents = |[low, high]: [f64; 2], room: f64| {
        let step = (room * (high - low)).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few decades")]
        let count = ((high - low) / step) as u32;
        (0..=count).map(move |i| low + step * f64::from(i))
    };
    for e in exponents(x, 1.0 / 12.0) {
        let at = plot.x0 + (e - x[0]) / (x[1] - x[0]) * plot.width();
        let foot = Point::new(at, plot.y1);
        group.mark(
            Mark::stroke(Shape::Line(foot, foot + Vec2::new(0.0, 1.2)), Pen::solid(FINE)).class("tick"),
        );
        let text = power(e).set(TICK);
        text.put(&mut group, foot + Vec2::new(-text.width / 2.0, 4.6), "tick");
    }
    for e in exponents(y, 1.0 / 12.0) {
        let at = plot.y1 - (e - y[0]) / (y[1] - y[0]) * plot.height();
        let foot = Point::new(plot.x0, at);
        group.mark(
            Mark::stroke(Shape::Line(foot, foot - Vec2::new(1.2, 0.0)), Pen::solid(FINE)).class("tick"),
        );
        let text = power(e).set(TICK);
        text.put(&mut group, foot + Vec2::new(-1.8 - text.width, 0.9), "tick");
    }
    let across = Rich::upright("time of a scene in µs").set(SMALL);
    across.put(&mut group, Point::new(plot.x1 - across.width, plot.y1 + 10.0), "axis-name");
    Rich::upright("error, as a part of the largest asked value of its unit").set(SMALL).put(
        &mut group,
        Point::new(10.0, plot.y0 - 3.5),
        "axis-name",
    );
    group
}
