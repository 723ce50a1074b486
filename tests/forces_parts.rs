//! What a sheet of forces draws, against values of the test's own: the parts of a force of which moments give them, the
//! energy of a turning-moment diagram as a curve, the lever with the figures that its result needs.

#![allow(clippy::unwrap_used, reason = "a test")]

use kurbo::{Point, Vec2};
use linkgram::drawing::{self, Wish};
use linkgram::sheet::figure::{Figure, Group, Node, Shape};

use crate::legibility::{data, has, sentences, within};

fn sheet(text: &str) -> Figure {
    let scene = linkgram::scene::read(text, "scene.json").unwrap_or_else(|error| panic!("{error}"));
    drawing::figure(&scene, &Wish::default()).unwrap_or_else(|error| panic!("{}", error.told(&scene)))
}

fn told(figure: &Figure) -> Vec<String> {
    sentences(figure).into_iter().map(|line| line.replace('\u{a0}', " ")).collect()
}

/// The two ends of an arrow, y upward.
fn arrow(group: &Group) -> Option<[Point; 2]> {
    let marks = || {
        group.children.iter().filter_map(|node| if let Node::Mark(mark) = node { Some(mark) } else { None })
    };
    let tail = marks().find_map(|mark| match &mark.shape {
        Shape::Line(from, _) if mark.class == "shaft" => Some(*from),
        _ => None,
    })?;
    let head = marks().find_map(|mark| match &mark.shape {
        Shape::Polygon(corners) if mark.class == "head" => corners.first().copied(),
        _ => None,
    })?;
    Some([tail, head].map(|at| Point::new(at.x, -at.y)))
}

/// The vectors of a force polygon, each with its name, its tail and what it is, newtons.
fn vectors(polygon: &Group) -> Vec<(String, Point, Vec2)> {
    let per_mm: f64 = data(polygon, "scale").unwrap().parse().unwrap();
    let own = within(polygon).into_iter().filter(|group| has(group, "vector"));
    own.filter_map(|group| {
        let [tail, head] = arrow(group)?;
        Some((data(group, "quantity").unwrap().to_owned(), tail, (head - tail) * per_mm))
    })
    .collect()
}

fn polygons(figure: &Figure) -> Vec<&Group> {
    within(&figure.root).into_iter().filter(|group| has(group, "force") && has(group, "polygon")).collect()
}

fn near(one: Vec2, other: Vec2, within: f64) {
    assert!((one - other).hypot() <= within, "{one:?} is not {other:?}");
}

/// Where circles about two points meet, to the left of the way from the first to the second.
fn meet(a: Vec2, ra: f64, b: Vec2, rb: f64) -> Vec2 {
    let (way, d) = (b - a, (b - a).hypot());
    let along = (d * d + ra * ra - rb * rb) / (2.0 * d);
    let up = (ra * ra - along * along).sqrt();
    let unit = way / d;
    a + unit * along + Vec2::new(-unit.y, unit.x) * up
}

/// A four-bar with a load on the coupler and one on the rocker, or a couple: the parts of F34 by moments of the test's own.
struct Loaded {
    scene: String,
    across: Vec2,
    along: Vec2,
}

fn loaded(couple: bool) -> Loaded {
    let (a, o4) = (Vec2::new(30.0, 30.0 * 3_f64.sqrt()), Vec2::new(200.0, 0.0));
    let b = meet(a, 180.0, o4, 140.0);
    let along = (b - o4) / 140.0;
    let across = Vec2::new(-along.y, along.x);
    let (p, q) = (Vec2::from_angle((-20_f64).to_radians()) * 100.0, Vec2::new(0.0, -150.0));
    // Newtons and millimetres about O4.
    let turning = if couple { -6000.0 } else { (along * 70.0).cross(p) };
    let t = -turning / 140.0;
    // −(t + n) at B and Q in the middle of AB about A.
    let n = ((b - a).cross(-across * t) + ((b - a) / 2.0).cross(q)) / (b - a).cross(along);
    let on_rocker = match couple {
        true => r#"{ "on": 4, "torque": "6 N*m cw" }"#,
        false => r#"{ "name": "P", "on": 4, "at": "C", "force": 100, "direction": -20 }"#,
    };
    let scene = format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [200, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }},
                    "3": {{ "joins": ["A", "B", "M"], "line": [0, 180, 90] }},
                    "4": {{ "joins": ["O4", "B", "C"], "line": [0, 140, 70] }} }},
        "near": {{ "B": [180, 140] }}, "input": {{ "link": 2, "angle": 60 }},
        "loads": [{on_rocker}, {{ "name": "Q", "on": 3, "at": "M", "force": 150, "direction": -90 }}],
        "find": ["F(3,4)", "F(1,4)", "T(2)"] }}"#
    );
    Loaded { scene, across: across * t, along: along * n }
}

#[test]
fn the_parts_that_moments_give_are_laid_off() {
    for couple in [false, true] {
        let Loaded { scene, across, along } = loaded(couple);
        let figure = sheet(&scene);
        // With a couple alone the rocker has no polygon: that of the coupler comes first.
        let (link, sign) = if couple { ("4,3", -1.0) } else { ("3,4", 1.0) };
        let names = [format!("Ft({link}/O4)"), format!("Fn({link}/O4)"), format!("F({link})")];
        let drawn: Vec<_> = polygons(&figure).into_iter().map(vectors).collect();
        let own: Vec<_> = drawn.iter().filter(|all| all.iter().any(|(name, ..)| *name == names[0])).collect();
        let [own] = own[..] else { panic!("{drawn:?}") };
        let find = |name: &String| {
            own.iter().find(|(of, ..)| of == name).unwrap_or_else(|| panic!("{name}: {own:?}"))
        };
        let [t, n, whole] = names.each_ref().map(find);
        near(t.2, across * sign, 1e-3);
        near(n.2, along * sign, 1e-3);
        near(whole.2, (across + along) * sign, 1e-3);
        // Head to tail, and the whole from the tail of the first to the head of the second.
        let per_mm: f64 =
            t.2.hypot() / (arrow_of(&figure, &names[0])[1] - arrow_of(&figure, &names[0])[0]).hypot();
        assert!((t.1 + t.2 / per_mm).distance(n.1) < 1e-3 && whole.1.distance(t.1) < 1e-3);
        // Without the whole, which its parts are, the polygon closes.
        let sum = own
            .iter()
            .filter(|(name, ..)| *name != names[2])
            .fold(Vec2::ZERO, |sum, (.., force)| sum + *force);
        near(sum, Vec2::ZERO, 1e-3);
        let lines = told(&figure);
        let digits = link.replace(',', "");
        let equation = format!("F_{digits} = F^t_{digits} + F^n_{digits}.");
        assert!(lines.iter().any(|line| line.ends_with(&equation)), "{equation}: {lines:#?}");
        // Both parts stand at B of both free bodies.
        for body in within(&figure.root).into_iter().filter(|group| has(group, "free-body")) {
            let (other, of) = match data(body, "link") {
                Some("3") => ("4", "3"),
                Some("4") => ("3", "4"),
                _ => continue,
            };
            for part in ["Ft", "Fn"] {
                let name = format!("{part}({other},{of}/O4)");
                assert!(within(body).iter().any(|group| data(group, "quantity") == Some(&name)), "{name}");
            }
        }
    }
}

fn arrow_of(figure: &Figure, name: &str) -> [Point; 2] {
    let all = within(&figure.root).into_iter().filter(|group| has(group, "vector"));
    all.filter(|group| data(group, "quantity") == Some(name)).find_map(arrow).unwrap()
}

/// The energy over the angle as it is drawn: degrees by 1 cm for so many, and joules.
fn energy(figure: &Figure, degrees_per_cm: f64) -> Vec<[f64; 2]> {
    let panel = within(&figure.root).into_iter().find(|group| group.class == "energy").unwrap();
    let per_mm: f64 = data(panel, "scale").unwrap().parse().unwrap();
    let curve = within(panel).into_iter().find(|group| has(group, "curve")).unwrap();
    let points = curve.children.iter().find_map(|node| match node {
        Node::Mark(mark) => match &mark.shape {
            Shape::Polyline(points) => Some(points.clone()),
            _ => None,
        },
        _ => None,
    });
    let (points, from) = (points.unwrap(), panel_origin(panel));
    points.iter().map(|at| [(at.x - from.x) * degrees_per_cm / 10.0, (from.y - at.y) * per_mm]).collect()
}

/// Where the axes of a panel cross: the tail of its first arrow.
fn panel_origin(panel: &Group) -> Point {
    let shaft = |node: &Node| match node {
        Node::Mark(mark) => match &mark.shape {
            Shape::Line(from, _) if mark.class == "shaft" => Some(*from),
            _ => None,
        },
        _ => None,
    };
    panel.children.iter().find_map(shaft).unwrap()
}

#[test]
fn the_energy_is_drawn_as_it_runs() {
    let waves = r#"{ "links": {}, "input": { "omega": "150 rpm" },
        "cycle": { "torque": { "harmonics": { "constant": 15000, "sin": [[2, 2000]], "cos": [[2, -1800]] } }, "period": 180 },
        "find": ["Ef"] }"#;
    let drawn = energy(&sheet(waves), 15.0);
    assert!(drawn.len() > 100, "{}", drawn.len());
    for [degrees, level] in &drawn {
        let (sin, cos) = libm::sincos(2.0 * degrees.to_radians());
        // ∫ 2000 sin 2θ − 1800 cos 2θ from 0; a hundredth of a millimetre on the page.
        let own = 1000.0 - 1000.0 * cos - 900.0 * sin;
        assert!((level - own).abs() < 1.0, "{degrees}: {level} is not {own}");
    }
    // Straight torques: parabolas between their corners.
    let table = r#"{ "links": {}, "input": { "omega": "100 rpm" },
        "cycle": { "torque": { "table": [[0, 0], [90, 300], [180, 0], [270, 100], [360, 0]] } }, "find": ["Ef"] }"#;
    let net = |degrees: f64| {
        let top = if degrees < 180.0 { 300.0 } else { 100.0 };
        let to = degrees % 180.0;
        top * (if to < 90.0 { to } else { 180.0 - to }) / 90.0 - 100.0
    };
    let drawn = energy(&sheet(table), 30.0);
    assert!(drawn.len() > 100, "{}", drawn.len());
    for [degrees, level] in &drawn {
        let steps = 4000;
        let width = degrees / f64::from(steps);
        let sum: f64 = (0..steps).map(|k| net((f64::from(k) + 0.5) * width)).sum();
        let own = sum * width.to_radians();
        assert!((level - own).abs() < 0.3, "{degrees}: {level} is not {own}");
    }
    // Clockwise the diagram runs down: 75 N·m over the mean from 30° to 120° of turning, 25 below it elsewhere.
    let clockwise = r#"{ "fixed": { "O2": [0, 0] }, "links": { "2": { "joins": ["O2", "A"], "length": 1 } },
        "input": { "link": 2, "angle": 0, "omega": "10 rad/s cw" },
        "loads": [{ "on": 2, "torque": { "table": [[0, 0], [240, 0], [240, -100], [330, -100], [330, 0]] } }],
        "cycle": { "torque": { "of": 2 } }, "find": ["Ef"] }"#;
    for [degrees, level] in energy(&sheet(clockwise), 30.0) {
        let turned = 360.0 - degrees;
        let own = (100.0 * (turned - 30.0).clamp(0.0, 90.0) - 25.0 * turned).to_radians();
        assert!((level - own).abs() < 0.1, "{degrees}: {level} is not {own}");
    }
}

/// Of more areas than are told one by one the highest and the lowest level are told as sums.
#[test]
fn many_areas_come_to_two_levels() {
    let areas: Vec<f64> =
        (0..30).map(|k: i32| f64::from(k % 7 + 3) * if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
    let rest: f64 = areas.iter().sum();
    let areas: Vec<f64> = areas.iter().copied().chain([-rest - 5.0, 5.0]).collect();
    let mut levels = Vec::new();
    let mut level = 0.0;
    for area in &areas {
        level += area;
        levels.push(level);
    }
    let scene = format!(
        r#"{{ "links": {{}}, "input": {{ "omega": "300 rpm" }},
        "cycle": {{ "torque": {{ "areas": {areas:?}, "scale": {{ "torque": "180 N*m", "angle": "1 rad" }} }}, "period": 360 }},
        "find": ["Ef"] }}"#
    );
    let lines = told(&sheet(&scene));
    for most in [true, false] {
        let better = |a: f64, b: f64| if most { a > b } else { a < b };
        let place = (0..levels.len())
            .reduce(|best, next| if better(levels[next], levels[best]) { next } else { best });
        let place = place.unwrap();
        let joule = 180.0 * levels[place];
        let line = lines
            .iter()
            .find(|line| line.contains(&format!("E_{} = A_1 + … + A_{} = ", place + 1, place + 1)));
        let line = line.unwrap_or_else(|| panic!("E{}: {lines:#?}", place + 1));
        let (value, half, _) = crate::legibility::number(line.rsplit('=').next().unwrap()).unwrap();
        assert!((value - joule).abs() <= half, "{line}: {joule}");
    }
}

/// A governor whose sleeve bears nothing is Watt's: ω² = g/h, by moments of its arm.
#[test]
fn a_sleeve_that_bears_nothing_is_left_out() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "placed": { "B": [150, -200], "E": [90, -120], "S": [0, -240] },
        "links": { "2": { "joins": ["O", "E", "B"] }, "3": { "joins": ["E", "S"] } },
        "slides": [{ "pin": "S", "block": 4, "on": { "link": 1, "through": "O", "angle": 90 } }],
        "input": { "link": 2 }, "gravity": {}, "masses": { "2": { "mass": 3, "at": "B" } },
        "spin": { "axis": { "through": [0, 0], "angle": 90 }, "omega": "?", "balls": 2, "sleeve": 4 }, "find": ["spin"] }"#;
    let lines = told(&sheet(scene));
    assert!(lines.iter().any(|line| line.contains("Moments of link 2 about O")), "{lines:#?}");
    assert!(!lines.iter().any(|line| line.contains("n proportion")), "{lines:#?}");
    let omega = (9.81_f64 / 0.2).sqrt();
    let speed = lines.iter().rev().find(|line| line.contains("rad/s")).unwrap();
    let told = speed
        .rsplit('=')
        .find_map(|part| part.contains("rad/s").then(|| crate::legibility::number(part)))
        .flatten();
    let (value, half, _) = told.unwrap();
    assert!((value - omega).abs() <= half, "{speed}: {omega}");
}

/// The lever's effort has a figure more than usual, and every number before it those that this needs: T₂ = P·V_C/ω₂ of a
/// shaper, V_C by the velocities of the test's own.
#[test]
fn the_lever_has_the_figures_that_it_needs() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O4": [0, 0], "O2": [0, 300] },
        "links": { "2": { "joins": ["O2", "A"], "length": 110 }, "4": { "joins": ["O4", "B"], "length": 600 },
                   "5": { "joins": ["B", "C"], "length": 170 } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } },
                    { "pin": "C", "block": 6, "on": { "link": 1, "through": [0, 640] } } ],
        "near": { "B": [-100, 590], "C": [60, 640] }, "input": { "link": 2, "angle": 120, "omega": "40 rpm ccw" },
        "loads": [ { "name": "P", "on": 6, "force": "1.5 kN", "direction": "against" } ],
        "find": [ { "name": "T(2)", "method": "lever" } ] }"#;
    // C over the crank angle, millimetres.
    let c = |theta: f64| {
        let (sin, cos) = libm::sincos(theta);
        let a = Vec2::new(110.0 * cos, 300.0 + 110.0 * sin);
        let b = a / a.hypot() * 600.0;
        b.x + (170.0_f64 * 170.0 - (640.0 - b.y) * (640.0 - b.y)).sqrt()
    };
    let (theta, step) = (120_f64.to_radians(), 1e-5);
    let arm = ((c(theta + step) - c(theta - step)) / (2.0 * step)).abs() / 1000.0;
    let effort = 1500.0 * arm;
    let lines = told(&sheet(scene));
    let line = lines.iter().find(|line| line.contains("−ΣM")).unwrap_or_else(|| panic!("{lines:#?}"));
    let parts: Vec<&str> = line.split('=').collect();
    let number = |text: &str| crate::legibility::number(text).map(|(value, half, _)| (value, half)).unwrap();
    let (value, half) = number(parts.last().unwrap());
    assert!(half < 0.06 && (value - effort).abs() <= 1.01 * half, "{line}: {effort}");
    let (first, second) = parts[parts.len() - 2].split_once('/').unwrap();
    let reckoned = number(first).0 / number(second).0;
    assert!((reckoned - value).abs() <= half, "{line}");
}
