//! Constructions on the skeleton against laws, closed forms and the analytic solver.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common::{cross, dot, minus, norm, plus, read, root};
use linkgram::analytic::{self, State};
use linkgram::check::agreement;
use linkgram::graphical::auxiliary::{AuxiliaryDrawing, PointName, StrokeRole, StrokeShape};
use linkgram::graphical::centrodes::{BranchEnd, Centrodes, Fineness, trace};
use linkgram::mechanism::quantity::{Answer, Indeterminate, Order, Quantity};
use linkgram::mechanism::structure::Structure;
use linkgram::mechanism::{LinkId, PointId};
use linkgram::plan::{Auxiliary, Extent};
use linkgram::scene::Scene;
use linkgram::sheet::{self, Language, overlap, scale};
use linkgram::solve::{Settings, solve, solve_analytically, solve_with};

fn kind(name: &str) -> String {
    std::fs::read_to_string(root().join(format!("src/catalogue/{name}.json"))).unwrap()
}

/// A ready scene with its crank elsewhere.
fn turned(name: &str, from: &str, angle: f64) -> Scene {
    let text = kind(name);
    assert!(text.contains(from), "{name} says {from}");
    read(&text.replace(from, &format!("\"angle\": {angle}, \"omega\"")))
}

/// One construction on the skeleton, its coordinates in metres of the world (the first fixed point is the origin).
fn drawing(scene: &Scene, name: &str) -> AuxiliaryDrawing {
    let auxiliary = sheet::auxiliary(name, scene).unwrap().unwrap();
    let solved =
        solve_with(scene, Extent::WholeSkeleton, &[auxiliary], Settings::default(), scale::for_scene)
            .unwrap();
    let construction = solved.solution.construction;
    let mut drawing = construction.auxiliary.into_iter().find(|a| a.kind == auxiliary).unwrap();
    for point in &mut drawing.points {
        point.at = point.at.map(|x| x * construction.space.metres_per_mm);
    }
    drawing
}

fn point(drawing: &AuxiliaryDrawing, name: PointName) -> [f64; 2] {
    drawing.points.iter().find(|p| p.name == name).unwrap_or_else(|| panic!("{name:?} in {drawing:?}")).at
}

fn vector(state: &State, quantity: Quantity) -> [f64; 2] {
    match state.answer(&quantity) {
        Answer::Vector { value, .. } => value,
        other => panic!("{quantity:?} is {other:?}"),
    }
}

fn scalar(state: &State, quantity: Quantity) -> f64 {
    match state.answer(&quantity) {
        Answer::Scalar { value, .. } => value,
        other => panic!("{quantity:?} is {other:?}"),
    }
}

/// Velocity and acceleration of any point of a link's plane, by the analytic solver.
fn motion(scene: &Scene, state: &State, link: LinkId, at: [f64; 2]) -> [[f64; 2]; 2] {
    let base = scene.mechanism.link(link).points[0];
    let r = minus(at, vector(state, Quantity::Position(base)));
    let (omega, alpha) = (scalar(state, Quantity::Omega(link)), scalar(state, Quantity::Alpha(link)));
    let v = plus(vector(state, Quantity::Velocity(base)), [-omega * r[1], omega * r[0]]);
    let turning = [-alpha * r[1] - omega * omega * r[0], alpha * r[0] - omega * omega * r[1]];
    [v, plus(vector(state, Quantity::Acceleration(base)), turning)]
}

/// The pole stands still, the acceleration centre has no acceleration, and the points of the inflection circle have
/// no acceleration across their way.
fn euler_savary_holds(scene: &Scene, number: u32) {
    let link = scene.mechanism.link_numbered(number).unwrap();
    let drawn = drawing(scene, &format!("inflection({number})"));
    assert_eq!(drawn.refused, None);
    let state = analytic::solve(&scene.mechanism, Order::Acceleration).unwrap();
    let pole = point(&drawn, PointName::Centre([LinkId::FRAME, link]));
    let summit = point(&drawn, PointName::InflectionPole);
    let omega = scalar(&state, Quantity::Omega(link)).abs();
    let diameter = norm(minus(summit, pole));
    // What the roundings of a far pole and a large circle may do.
    let reach = norm(pole) + diameter + 0.1;
    let (speed, rate) =
        (omega * reach, omega * omega * reach + scalar(&state, Quantity::Alpha(link)).abs() * reach);
    let part = 1e-10 * (1.0 + diameter / 0.1);
    assert!(norm(motion(scene, &state, link, pole)[0]) < part * speed, "the pole moves");
    let centre = point(&drawn, PointName::AccelerationCentre);
    assert!(
        norm(motion(scene, &state, link, centre)[1]) < part * rate,
        "the acceleration centre is accelerated"
    );
    let middle = [0, 1].map(|k| f64::midpoint(pole[k], summit[k]));
    for step in 1..12 {
        let (sin, cos) = libm::sincos(f64::from(step) * 0.5);
        let r = minus(summit, middle);
        let on = plus(middle, [r[0] * cos - r[1] * sin, r[0] * sin + r[1] * cos]);
        let [v, a] = motion(scene, &state, link, on);
        assert!(cross(v, a).abs() < part * speed * rate, "{on:?} does not run straight");
    }
}

#[test]
fn the_inflection_circle_of_couplers() {
    for step in 0..36 {
        let angle = f64::from(step) * 10.0 + 3.0;
        euler_savary_holds(&turned("four-bar", "\"angle\": 60, \"omega\"", angle), 3);
        euler_savary_holds(&turned("slider-crank-offset", "\"angle\": 50, \"omega\"", angle), 3);
    }
}

/// Where no path centre is known the inflection points come from the acceleration polygon.
#[test]
fn the_inflection_circle_of_a_link_whose_path_centres_are_not_known() {
    euler_savary_holds(&read(&kind("six-link")), 5);
    euler_savary_holds(&read(&kind("two-sliders")), 5);
}

#[test]
fn a_link_that_only_translates_has_no_inflection_circle() {
    let scene = read(&kind("parallel-crank"));
    let drawn = drawing(&scene, "inflection");
    assert!(drawn.refused.is_some_and(|why| why.contains("no inflection circle")), "{:?}", drawn.refused);
}

fn with_find(name: &str, find: &str) -> Scene {
    let text = kind(name);
    let end = text.trim_end().strip_suffix('}').unwrap().trim_end().to_owned();
    let end = match end.find("\"find\"") {
        Some(at) => end[..at].trim_end().trim_end_matches(',').to_owned(),
        None => end,
    };
    read(&format!("{end}, \"find\": [{find}] }}"))
}

#[test]
fn radii_of_curvature() {
    let scene = with_find("coupler-point", r#""rho(A)", "rho(B)", "rho(C)""#);
    let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
    let checked = agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(
        checked.ok() && checked.compared.iter().all(|c| c.difference.is_some()),
        "{:?}",
        checked.compared
    );
    let radius = |i: usize| match &checked.compared[i].graphical.answer {
        Answer::Scalar { value, bound } => (*value, *bound),
        other => panic!("{other:?}"),
    };
    // The pins run on circles about their pivots.
    let m = &scene.mechanism;
    let state = analytic::solve(m, Order::Position).unwrap();
    let place = |name: &str| vector(&state, Quantity::Position(m.point_named(name).unwrap()));
    for (i, pivot, pin) in [(0, "O2", "A"), (1, "O4", "B")] {
        let (value, bound) = radius(i);
        let length = norm(minus(place(pin), place(pivot)));
        assert!((value - length).abs() <= bound + 1e-15, "{pin}: {value} for {length}");
    }
    // Euler–Savary for the coupler point: ρ = PC² / CC_w, C_w the inflection point on its pole ray.
    let drawn = drawing(&scene, "inflection(3)");
    let pole = point(&drawn, PointName::Centre([LinkId::FRAME, m.link_numbered(3).unwrap()]));
    let summit = point(&drawn, PointName::InflectionPole);
    let ray = minus(pole, place("C"));
    let along = dot(minus(summit, place("C")), ray) / norm(ray);
    let (value, _) = radius(2);
    let expected = dot(ray, ray) / along.abs();
    assert!((value - expected).abs() < 1e-9 * expected, "{value} for {expected}");
}

#[test]
fn a_straight_path_has_no_radius() {
    let scene = with_find("slider-crank", r#""rho(B)", "rho(A)""#);
    let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
    let checked = agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(checked.ok(), "{:?}", checked.compared);
    for answer in [&checked.compared[0].graphical.answer, &checked.compared[0].analytic] {
        let Answer::Indeterminate(Indeterminate::Undefined { why }) = answer else { panic!("{answer:?}") };
        assert!(why.contains("straight"), "{why}");
    }
}

const FINE: Fineness = Fineness { tolerance: 2e-5, reach: 2.0 };

fn centrodes(scene: &Scene, numbers: [u32; 2]) -> Centrodes {
    centrodes_within(scene, numbers, FINE)
}

fn centrodes_within(scene: &Scene, numbers: [u32; 2], fineness: Fineness) -> Centrodes {
    let structure = Structure::of(&scene.mechanism).unwrap();
    let links = numbers.map(|n| scene.mechanism.link_numbered(n).unwrap());
    trace(&scene.mechanism, &structure, links, fineness).unwrap_or_else(|error| panic!("{error}"))
}

fn points(branches: &[linkgram::graphical::centrodes::Branch]) -> Vec<[f64; 2]> {
    let all: Vec<[f64; 2]> = branches.iter().flat_map(|b| b.points.iter().copied()).collect();
    assert!(all.len() > 50, "only {} points", all.len());
    all
}

/// Cardan: the moving centrode of a trammel of length l is the circle on it, the fixed one has the radius l.
#[test]
fn the_elliptic_trammel_rolls_a_circle_in_one_of_twice_its_size() {
    let scene = read(&kind("elliptic-trammel"));
    let state = analytic::solve(&scene.mechanism, Order::Position).unwrap();
    let place = |name: &str| vector(&state, Quantity::Position(scene.mechanism.point_named(name).unwrap()));
    let (a, b) = (place("A"), place("B"));
    let middle = [0, 1].map(|k| f64::midpoint(a[k], b[k]));
    let found = centrodes(&scene, [1, 3]);
    for p in points(&found.fixed) {
        assert!((norm(minus(p, place("O"))) - 0.2).abs() < 1e-12, "{p:?}");
    }
    for p in points(&found.moving) {
        assert!((norm(minus(p, middle)) - 0.1).abs() < 1e-12, "{p:?}");
    }
    // The slide that drives it goes from one end of the trammel to the other.
    for branch in &found.fixed {
        assert_eq!(branch.ends, [BranchEnd::Limit; 2]);
        for (end, way) in [(branch.points[0], -1.0), (branch.points[branch.points.len() - 1], 1.0)] {
            assert!((end[1] - way * 0.2).abs() < 1e-6 && end[0].abs() < 1e-3, "{end:?}");
        }
    }
}

/// Crossed cranks on a long frame: hyperbolas with the pivots and with the pins as foci, that run to infinity along their
/// asymptotes.
#[test]
fn antiparallel_cranks_roll_hyperbolas() {
    let scene = read(&kind("antiparallel-crank"));
    let state = analytic::solve(&scene.mechanism, Order::Position).unwrap();
    let place = |name: &str| vector(&state, Quantity::Position(scene.mechanism.point_named(name).unwrap()));
    let crank = norm(minus(place("A"), place("O2")));
    let frame = norm(minus(place("O4"), place("O2")));
    let found = centrodes(&scene, [1, 3]);
    for (branches, foci) in [(&found.fixed, ["O2", "O4"]), (&found.moving, ["A", "B"])] {
        let [f, g] = foci.map(place);
        for p in points(branches) {
            let difference = (norm(minus(p, f)) - norm(minus(p, g))).abs();
            // Beside a change point both lines of centres lie in one, and the centre is only as good as asked for.
            let off_axis = cross(minus(p, f), minus(g, f)).abs() / frame;
            let within = if off_axis < 1e-3 { FINE.tolerance } else { 1e-9 * (1.0 + norm(p) / crank) };
            assert!((difference - crank).abs() < within, "{p:?}: {difference}");
        }
        let axis = minus(g, f);
        let mut seen = 0;
        for end in branches.iter().flat_map(|b| b.ends) {
            let BranchEnd::Infinity(direction) = end else { continue };
            seen += 1;
            let cos = dot(direction, axis).abs() / norm(axis);
            assert!((cos - crank / frame).abs() < 1e-7, "{direction:?}");
        }
        let ends: Vec<_> = branches
            .iter()
            .map(|b| (b.points.len(), b.points[0], b.points[b.points.len() - 1], b.ends))
            .collect();
        assert_eq!(seen, 4, "two branches with two ends each: {ends:?}");
    }
}

/// The piece of a locus nearest to a place: its distance, and its direction.
fn nearest(branches: &[linkgram::graphical::centrodes::Branch], at: [f64; 2]) -> (f64, [f64; 2]) {
    let mut best = (f64::INFINITY, [0.0; 2]);
    for pair in branches.iter().flat_map(|b| b.points.windows(2)) {
        let d = minus(pair[1], pair[0]);
        let t = (dot(minus(at, pair[0]), d) / dot(d, d)).clamp(0.0, 1.0);
        let away = norm(minus(at, plus(pair[0], [d[0] * t, d[1] * t])));
        if away < best.0 && norm(d) > 0.0 {
            best = (away, [d[0] / norm(d), d[1] / norm(d)]);
        }
    }
    best
}

#[test]
fn centrodes_touch_in_the_present_centre() {
    let finest = Fineness { tolerance: 1e-7, ..FINE };
    for (name, from, links) in [
        ("four-bar", "\"angle\": 60, \"omega\"", [1, 3]),
        ("four-bar", "\"angle\": 60, \"omega\"", [2, 4]),
        ("slider-crank-offset", "\"angle\": 50, \"omega\"", [1, 3]),
        ("slider-crank-offset", "\"angle\": 50, \"omega\"", [2, 4]),
    ] {
        for angle in [10.0, 75.0, 130.0, 200.0, 250.0, 340.0] {
            let scene = turned(name, from, angle);
            let state = analytic::solve(&scene.mechanism, Order::Velocity).unwrap();
            let ids = links.map(|n| scene.mechanism.link_numbered(n).unwrap());
            let Answer::Vector { value: centre, .. } = state.answer(&Quantity::Centre(ids[0], ids[1])) else {
                continue;
            };
            if norm(centre) > FINE.reach {
                continue;
            }
            let found = centrodes_within(&scene, links, finest);
            let ((off, one), (other_off, other)) =
                (nearest(&found.fixed, centre), nearest(&found.moving, centre));
            let case = format!("{name} {links:?} at {angle}°: {off} {other_off} {one:?} {other:?}");
            assert!(off <= finest.tolerance && other_off <= finest.tolerance, "{case}");
            // Two pieces of a curve of 20 mm radius that keep this tolerance turn by √(8 × 1e-7 / 0.02) at most.
            assert!(cross(one, other).abs() < 6.4e-3, "{case}");
            // The second rolls the way the first runs.
            assert!(dot(one, other) > 0.0, "{case}");
        }
    }
}

/// Rolling without sliding: over a whole turn both loci are equally long.
#[test]
fn closed_centrodes_are_equally_long() {
    // Crossed cranks on a short frame: ellipses.
    let text = r#"{"fixed": {"O2": [0, 0], "O4": [0.04, 0]},
        "links": {"2": {"joins": ["O2", "A"], "length": 0.1}, "3": {"joins": ["A", "B"], "length": 0.04},
                  "4": {"joins": ["O4", "B"], "length": 0.1}},
        "near": {"B": [-0.037, 0.064]}, "input": {"link": 2, "angle": 100, "omega": 10}}"#;
    let scene = read(text);
    let found = centrodes(&scene, [1, 3]);
    let length = |branches: &[linkgram::graphical::centrodes::Branch]| -> f64 {
        branches.iter().flat_map(|b| b.points.windows(2)).map(|w| norm(minus(w[1], w[0]))).sum()
    };
    let (one, other) = (length(&found.fixed), length(&found.moving));
    // An ellipse with half axes a = r/2 and b = √(r² − d²)/2, by Ramanujan's second approximation.
    let (a, b) = (0.05, libm::sqrt(0.01 - 0.0016) / 2.0);
    let h = (a - b) * (a - b) / ((a + b) * (a + b));
    let ellipse = std::f64::consts::PI * (a + b) * (1.0 + 3.0 * h / (10.0 + libm::sqrt(4.0 - 3.0 * h)));
    for length in [one, other] {
        // The pieces leave out a two-thousandth beside each change point at most.
        assert!((length - ellipse).abs() < 1e-3 * ellipse, "{one} {other}, an ellipse has {ellipse}");
    }
}

#[test]
fn a_rocker_s_centrodes_end_with_its_range() {
    let scene = read(&kind("rocker-crank"));
    let coupler = scene.mechanism.link_numbered(3).unwrap();
    let found = centrodes(&scene, [1, scene.mechanism.link(coupler).number]);
    let ends: Vec<BranchEnd> = found.fixed.iter().flat_map(|b| b.ends).collect();
    assert_eq!(ends.iter().filter(|e| **e == BranchEnd::Limit).count(), 2, "{ends:?}");
}

/// Of two positions by the analytic solver the rotation centre has the same distance before and after.
#[test]
fn the_centre_of_a_finite_rotation() {
    for (to, near) in [(200.0, [0.05, 0.05]), (110.0, [0.08, 0.07]), (61.0, [0.125, 0.08])] {
        let scene = read(&kind("four-bar"));
        let drawn = drawing(&scene, &format!("rotation-centre({to})"));
        let centre = point(&drawn, PointName::RotationCentre);
        let text = kind("four-bar").replace("\"angle\": 60", &format!("\"angle\": {to}"));
        let text = text.replace("[125, 80]", &format!("[{}, {}]", near[0] * 1000.0, near[1] * 1000.0));
        let before = analytic::solve(&scene.mechanism, Order::Velocity).unwrap();
        let after = analytic::solve(&read(&text).mechanism, Order::Position).unwrap();
        for name in ["A", "B"] {
            let p = scene.mechanism.point_named(name).unwrap();
            let way =
                [&before, &after].map(|state| norm(minus(vector(state, Quantity::Position(p)), centre)));
            assert!((way[0] - way[1]).abs() < 1e-9 * (1.0 + way[0]), "{name} at {to}: {way:?}");
        }
        if to == 61.0 {
            // A small rotation turns about nearly the instant centre.
            let coupler = scene.mechanism.link_numbered(3).unwrap();
            let pole = vector(&before, Quantity::Centre(LinkId::FRAME, coupler));
            assert!(norm(minus(pole, centre)) < 0.1 * norm(pole), "{pole:?} {centre:?}");
        }
    }
}

#[test]
fn kennedy_s_trial_velocities_differ() {
    for name in ["four-bar", "slider-crank", "whitworth"] {
        let scene = read(&kind(name));
        let drawn = drawing(&scene, "kennedy");
        assert_eq!(drawn.refused, None, "{name}");
        let trial = point(&drawn, PointName::Trial);
        let Auxiliary::Kennedy { links: [base, one, other] } = drawn.kind else { panic!() };
        let arrows = [one, other].map(|link| minus(point(&drawn, PointName::TrialVelocity(link)), trial));
        assert!(cross(arrows[0], arrows[1]).abs() > 0.01 * norm(arrows[0]) * norm(arrows[1]), "{name}");
        let centres: Vec<[f64; 2]> =
            drawn.points.iter().filter(|p| matches!(p.name, PointName::Centre(_))).map(|p| p.at).collect();
        if let [a, b, c] = centres.as_slice() {
            let area = cross(minus(*b, *a), minus(*c, *a)).abs();
            assert!(
                area < 1e-12 * norm(minus(*b, *a)) * (norm(minus(*c, *a)) + 1.0),
                "{name}: not on one line"
            );
        }
        for (arrow, link) in arrows.iter().zip([one, other]) {
            let centre =
                drawn.points.iter().find(|p| p.name == PointName::Centre(linkgram::plan::chord(base, link)));
            if let Some(centre) = centre {
                assert!(
                    dot(*arrow, minus(centre.at, trial)).abs() < 1e-12,
                    "{name}: not square to its radius"
                );
            }
        }
    }
}

/// What a line claims is true in the drawing.
#[test]
fn claims_of_auxiliary_lines_hold() {
    use linkgram::graphical::construction::{Claim, Reference};
    for (name, figure) in
        [("slider-crank-offset", "klein"), ("four-bar", "inflection"), ("slider-crank", "inflection")]
    {
        let scene = read(&kind(name));
        let drawn = drawing(&scene, figure);
        let state = analytic::solve(&scene.mechanism, Order::Position).unwrap();
        let place = |p: PointId| vector(&state, Quantity::Position(p));
        let mut seen = 0;
        for stroke in &drawn.strokes {
            let (Some(claim), StrokeShape::Line(from, to)) = (stroke.claim, &stroke.shape) else { continue };
            let (Claim::Parallel(reference) | Claim::Perpendicular(reference)) = claim;
            let along = match reference {
                Reference::Points(p, q) => minus(place(q), place(p)),
                // Both scenes have level guides.
                Reference::Guide(_) => [1.0, 0.0],
            };
            let line = minus(*to, *from);
            let size = norm(line) * norm(along);
            let miss = match claim {
                Claim::Parallel(_) => cross(line, along),
                Claim::Perpendicular(_) => dot(line, along),
            };
            assert!(miss.abs() <= 1e-9 * size, "{name} {figure}: {stroke:?}");
            seen += 1;
        }
        assert!(seen >= 2, "{name} {figure}");
    }
}

#[test]
fn the_figures_are_legible() {
    for (name, figure) in [
        ("slider-crank", "klein"),
        ("slider-crank-offset", "klein"),
        ("four-bar", "inflection"),
        ("slider-crank", "inflection"),
        ("coupler-point", "inflection"),
        ("four-bar", "centrodes"),
        ("elliptic-trammel", "centrodes"),
        ("antiparallel-crank", "centrodes"),
        ("four-bar", "kennedy"),
        ("slider-crank", "kennedy"),
        ("four-bar", "rotation-centre(200)"),
    ] {
        let scene = read(&kind(name));
        let auxiliary = sheet::auxiliary(figure, &scene).unwrap().unwrap();
        let solved =
            solve_with(&scene, Extent::WholeSkeleton, &[auxiliary], Settings::default(), scale::for_scene)
                .unwrap();
        let drawn = sheet::single(&scene, &solved.solution.construction, figure, Language::English).unwrap();
        let overlaps = overlap::overlaps(&drawn);
        assert!(overlaps.is_empty(), "{name} {figure}: {overlaps:?}");
        let ink = drawn.root.bounds().unwrap();
        assert!(ink.x0 >= 0.0 && ink.y0 >= 0.0 && ink.x1 <= drawn.width && ink.y1 <= drawn.height);
        assert!(drawn.width <= 210.0, "{name} {figure} is {} mm wide", drawn.width);
    }
}

#[test]
fn moving_centrodes_are_dashed() {
    let scene = read(&kind("four-bar"));
    let drawn = drawing(&scene, "centrodes");
    let roles = |role| drawn.strokes.iter().filter(|s| s.role == role).count();
    assert!(roles(StrokeRole::Result) > 0 && roles(StrokeRole::Counterpart) > 0);
}

#[test]
fn figures_with_wrong_arguments_say_what_is_wrong() {
    let four_bar = read(&kind("four-bar"));
    for (figure, told) in [
        ("klein", "no slider-crank"),
        ("inflection(9)", "no link 9"),
        ("inflection(2)", "fixed pivot"),
        ("inflection(3", "write inflection"),
        ("kennedy(1,2)", "write kennedy"),
        ("kennedy(1,2,2)", "twice"),
        ("rotation-centre", "write rotation-centre"),
        ("rotation-centre(far)", "not a number"),
        ("skeleton(3)", "no arguments"),
    ] {
        let error = sheet::auxiliary(figure, &four_bar).unwrap_err();
        assert!(error.contains(told), "{figure}: {error}");
    }
    assert_eq!(sheet::auxiliary("skeleton", &four_bar).unwrap(), None);
}
