//! Laws of the graphical method over random chains of three to ten links, and the two solvers against each
//! other.
//!
//! The chains come from `common/chains.rs`, which assembles them by its own geometry. The tolerances are the
//! bounds that the answers carry; what a test adds is the rounding of its own few operations.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use crate::common::chains::{Chain, chains, flat_chains};
use crate::common::{Drawn, cross, dot, minus, norm, plus};
use linkgram::analytic;
use linkgram::check::agreement;
use linkgram::graphical::construction::{Claim, ConstructionLine, Diagram, Label, Reference, VectorKind};
use linkgram::mechanism::quantity::{Answer, DiagramKind, Order, Quantity};
use linkgram::plan::Extent;
use linkgram::solve::Solved;
use proptest::prelude::*;

const CASES: u32 = 128;

fn drawn(chain: &Chain) -> Drawn {
    common::draw(&common::read(&chain.text))
}

/// Rounding of a few operations on numbers of this size.
fn rounding(size: f64) -> f64 {
    8.0 * f64::EPSILON * size
}

/// Speed of a point; a fixed one rests.
fn vector(d: &Drawn, letter: &str, point: &str) -> ([f64; 2], f64) {
    if d.scene.mechanism.is_fixed(d.point(point)) {
        return ([0.0; 2], 0.0);
    }
    d.vector(&format!("{letter}({point})"))
}

fn place(d: &Drawn, chain: &Chain, point: &str) -> ([f64; 2], f64) {
    if d.scene.mechanism.is_fixed(d.point(point)) {
        return (chain.place(point), rounding(norm(chain.place(point))));
    }
    d.vector(&format!("x({point})"))
}

/// Every pair of points of one link.
fn pairs(chain: &Chain) -> impl Iterator<Item = (u32, &str, &str)> {
    chain.links.iter().flat_map(|link| {
        let joins = &link.joins;
        (0..joins.len())
            .flat_map(move |i| (0..i).map(move |j| (link.number, joins[j].as_str(), joins[i].as_str())))
    })
}

fn polygons(d: &Drawn) -> impl Iterator<Item = &Diagram> {
    d.solution.construction.diagrams.iter()
}

proptest! {
    #![proptest_config(common::fixed(CASES))]

    /// The skeleton is the chain that was made: every point within a part in 10⁹ of where its maker put it.
    #[test]
    fn the_skeleton_is_the_chain(chain in chains()) {
        let d = drawn(&chain);
        prop_assert_eq!(d.structure.mobility.freedoms, 1);
        prop_assert_eq!(d.structure.mobility.links, chain.count);
        let size = chain.places.iter().map(|(_, p)| norm(*p)).fold(0.0, f64::max);
        for (name, made) in &chain.places {
            let (at, _) = place(&d, &chain, name);
            prop_assert!(norm(minus(at, *made)) <= 1e-9 * size, "{name}: {at:?} {made:?}");
        }
    }

    /// Image laws: v_Q − v_P = ω × PQ and a_Q − a_P = α × PQ − ω² PQ, so each image of a link is the link
    /// enlarged by |ω| and √(ω⁴ + α²).
    #[test]
    fn every_image_is_similar_to_its_link(chain in chains()) {
        let d = drawn(&chain);
        for (number, p, q) in pairs(&chain) {
            let (omega, omega_bound) = d.scalar(&format!("omega({number})"));
            let (alpha, alpha_bound) = d.scalar(&format!("alpha({number})"));
            let ((xp, bp), (xq, bq)) = (place(&d, &chain, p), place(&d, &chain, q));
            let way = minus(xq, xp);
            let (arm, arm_bound) = (norm(way), bp + bq);
            let left = [-way[1], way[0]];

            let ((vp, bvp), (vq, bvq)) = (vector(&d, "v", p), vector(&d, "v", q));
            let law = minus(minus(vq, vp), left.map(|x| omega * x));
            let bound = bvp + bvq + omega_bound * (arm + arm_bound) + omega.abs() * arm_bound
                + rounding(norm(vp) + norm(vq) + omega.abs() * arm);
            prop_assert!(norm(law) <= bound, "velocity of {number} {p}{q}: {law:?}, bound {bound:e}");
            let enlarged = (norm(minus(vq, vp)) - omega.abs() * arm).abs();
            prop_assert!(enlarged <= bound, "velocity image of {number}: {enlarged:e}, bound {bound:e}");

            let ((ap, bap), (aq, baq)) = (vector(&d, "a", p), vector(&d, "a", q));
            let turn = [0, 1].map(|k| alpha * left[k] - omega * omega * way[k]);
            let law = minus(minus(aq, ap), turn);
            let square_bound = (2.0 * omega.abs() + omega_bound) * omega_bound;
            let factor = libm::hypot(omega * omega, alpha);
            let bound = bap + baq + (alpha_bound + square_bound) * (arm + arm_bound) + factor * 2.0 * arm_bound
                + rounding(norm(ap) + norm(aq) + 2.0 * factor * arm);
            prop_assert!(norm(law) <= bound, "acceleration of {number} {p}{q}: {law:?}, bound {bound:e}");
            let enlarged = (norm(minus(aq, ap)) - factor * arm).abs();
            prop_assert!(enlarged <= bound, "acceleration image of {number}: {enlarged:e}, bound {bound:e}");
        }
    }

    /// The image of a link with three points has the link's own reading sense and its proportions, as it
    /// stands on the paper.
    #[test]
    fn image_triangles_have_the_reading_sense_of_their_links(chain in chains()) {
        let d = drawn(&chain);
        for polygon in polygons(&d) {
            for image in &polygon.link_images {
                let number = d.scene.mechanism.link(image.link).number;
                let (omega, _) = d.scalar(&format!("omega({number})"));
                let (alpha, _) = d.scalar(&format!("alpha({number})"));
                let factor = if polygon.kind == DiagramKind::Velocity { omega.abs() } else { libm::hypot(omega * omega, alpha) };
                let letter = if polygon.kind == DiagramKind::Velocity { "v" } else { "a" };
                let names: Vec<&str> =
                    image.corners.iter().map(|(p, _)| d.scene.mechanism.point(*p).name.as_str()).collect();
                let [k0, k1, k2] = [0, 1, 2].map(|k| place(&d, &chain, names[k]));
                let area = cross(minus(k1.0, k0.0), minus(k2.0, k0.0));
                let [c0, c1, c2] = [0, 1, 2].map(|k| image.corners[k].1.map(|mm| mm * polygon.si_per_mm));
                let image_area = cross(minus(c1, c0), minus(c2, c0));
                // Corners are the answers, so their bounds are the answers'.
                let size = [c0, c1, c2].map(norm).iter().copied().fold(0.0, f64::max);
                let mut corner_bound = rounding(size);
                for (name, corner) in names.iter().zip([c0, c1, c2]) {
                    let (value, bound) = vector(&d, letter, name);
                    prop_assert!(norm(minus(value, corner)) <= rounding(size), "{letter}({name}) is not its image");
                    corner_bound += bound;
                }
                let spread = norm(minus(c1, c0)) + norm(minus(c2, c0)) + corner_bound;
                let place_bound = k0.1 + k1.1 + k2.1;
                let reach = norm(minus(k1.0, k0.0)) + norm(minus(k2.0, k0.0)) + place_bound;
                let bound = 2.0 * corner_bound * spread + factor * factor * 2.0 * place_bound * reach
                    + rounding(spread * spread + factor * factor * reach * reach) + 4.0 * factor * reach * corner_bound;
                let expected = factor * factor * area;
                prop_assert!((image_area - expected).abs() <= bound, "{letter} image of {number}: {image_area:e} for {expected:e}");
                if expected.abs() > bound {
                    prop_assert_eq!(image_area > 0.0, area > 0.0, "reading sense of {}", number);
                }
            }
        }
    }

    /// Polygons close: every vector runs from the image that it names to the image that it names, and
    /// v(B) = v(A) + v(B/A), a(B) = a(A) + aⁿ(B/A) + aᵗ(B/A).
    #[test]
    fn polygons_close(chain in chains()) {
        let d = drawn(&chain);
        for polygon in polygons(&d) {
            for vector in &polygon.vectors {
                for (label, at) in [(vector.tail, vector.from), (vector.head, vector.to)] {
                    let stands = label == Label::Pole && at == [0.0; 2]
                        || polygon.images.iter().any(|i| i.label == label && i.at == at);
                    prop_assert!(stands, "{:?} of {:?} is at no {:?}", vector.kind, vector.quantity, label);
                }
            }
            prop_assert!(!polygon.vectors.is_empty());
        }
        for (_, a, b) in pairs(&chain) {
            let [Some(v), Some(whole), Some(normal), Some(tangential)] = ["v", "a", "an", "at"].map(|part| {
                let name = format!("{part}({b}/{a})");
                d.scene.mechanism.asked.iter().any(|q| q.name == name).then(|| d.vector(&name))
            }) else { continue };
            let sums = [
                (vector(&d, "v", b), vector(&d, "v", a), v),
                (vector(&d, "a", b), vector(&d, "a", a), whole),
                (whole, normal, tangential),
            ];
            for ((sum, b0), (first, b1), (second, b2)) in sums {
                let open = norm(minus(sum, plus(first, second)));
                let bound = b0 + b1 + b2 + rounding(norm(sum) + norm(first) + norm(second));
                prop_assert!(open <= bound, "{a}{b}: open by {open:e}, bound {bound:e}");
            }
            // The parts are what their names say.
            let way = minus(place(&d, &chain, b).0, place(&d, &chain, a).0);
            let slack = |bound: f64, size: f64| bound + 1e-9 * size;
            prop_assert!((cross(normal.0, way) / norm(way)).abs() <= slack(normal.1, norm(normal.0)));
            prop_assert!(dot(normal.0, way) <= 0.0, "the normal part points from {b} to {a}");
            prop_assert!((dot(tangential.0, way) / norm(way)).abs() <= slack(tangential.1, norm(whole.0)));
        }
    }

    /// Every claimed ∥ and ⊥ is true to 1e-6 rad + 1e-6 mm / length, against the places that the maker of
    /// the chain knows.
    #[test]
    fn claims_of_direction_are_true(chain in chains()) {
        let d = drawn(&chain);
        let name = |p: linkgram::mechanism::PointId| d.scene.mechanism.point(p).name.as_str();
        let mut claims = Vec::new();
        for polygon in polygons(&d) {
            claims.extend(polygon.vectors.iter().map(|v| (v.from, v.to, v.claim)));
            claims.extend(polygon.lines.iter().map(|line| match *line {
                ConstructionLine::Ray { from, to, claim, .. } => (from, to, claim),
                ConstructionLine::Arc { centre, at, .. } => (centre, at, None),
            }));
        }
        let mut seen = 0;
        for (from, to, claim) in claims {
            let Some(claim) = claim else { continue };
            let (reference, square) = match claim {
                Claim::Parallel(reference) => (reference, false),
                Claim::Perpendicular(reference) => (reference, true),
                #[allow(unreachable_patterns, reason = "kinds of claims may be added")]
                _ => continue,
            };
            let line = match reference {
                Reference::Points(p, q) => minus(chain.place(name(q)), chain.place(name(p))),
                Reference::Guide(slide) => chain.guides[slide],
                #[allow(unreachable_patterns, reason = "kinds of references may be added")]
                _ => continue,
            };
            let drawn = minus(to, from);
            let length = norm(drawn);
            if length == 0.0 {
                continue;
            }
            let sine = if square { dot(drawn, line) } else { cross(drawn, line) } / (length * norm(line));
            let allowed = 1e-6 + 1e-6 / length;
            prop_assert!(sine.abs() <= allowed, "{claim:?}: off by {sine:e}, allowed {allowed:e}");
            seen += 1;
        }
        prop_assert!(seen >= 4);
        // Normal and tangential parts always claim one.
        for polygon in polygons(&d) {
            for vector in &polygon.vectors {
                if vector.kind == VectorKind::Normal {
                    prop_assert!(matches!(vector.claim, Some(Claim::Parallel(_))));
                }
            }
        }
    }

    /// The two solvers agree within the sum of their bounds.
    #[test]
    fn graphical_and_analytic_agree(chain in chains()) {
        let (worst, compared, _) = agree(&chain)?;
        prop_assert!(worst <= 1.0);
        prop_assert_eq!(compared, common::read(&chain.text).mechanism.asked.len());
    }

    /// They agree near dead centres as well, or say that there is no number.
    #[test]
    fn graphical_and_analytic_agree_near_dead_centres(chain in flat_chains()) {
        agree(&chain)?;
    }

    /// Bounds are no more than 10⁴ times what half a unit in the last place of every given number does to
    /// the answer.
    #[test]
    fn bounds_are_within_ten_thousand_times_the_conditioning(chain in chains()) {
        // A dyad on one link stands still against it whatever the numbers: zero has no conditioning.
        prop_assume!(!chain.stiff);
        let d = drawn(&chain);
        let conditioning = conditioning(&d);
        for (asked, (reading, conditioned)) in
            d.scene.mechanism.asked.iter().zip(d.solution.construction.answers.iter().zip(conditioning))
        {
            let (Answer::Scalar { bound, .. } | Answer::Vector { bound, .. }) = reading.answer else {
                return Err(TestCaseError::fail(format!("{}: {:?}", asked.name, reading.answer)));
            };
            prop_assert!(bound <= 1e4 * conditioned, "{}: bound {bound:e}, conditioning {conditioned:e}", asked.name);
        }
    }
}

/// Solves by both solvers: the worst ratio, how many numbers were compared, and how many are indeterminate.
fn agree(chain: &Chain) -> Result<(f64, usize, usize), TestCaseError> {
    let scene = common::read(&chain.text);
    // A chain that is flat to rounding may be called tangent or not closing; then there is no drawing.
    let Ok(d) = common::try_draw(&scene, Extent::Asked) else { return Ok((0.0, 0, 0)) };
    let (structure, plan, scales, solution) = (d.structure, d.plan, d.scales, d.solution);
    let solved = Solved { structure, plan, scales, solution, left_out: None };
    let state = analytic::solve(&scene.mechanism, Order::Acceleration);
    let agreement = agreement(&scene, &solved, &state);
    prop_assert!(agreement.refused.is_none(), "refused: {:?}", agreement.refused);
    prop_assert!(agreement.elsewhere.is_none(), "wrong branch at {:?}", agreement.elsewhere);
    for c in &agreement.compared {
        if let Some(difference) = c.difference {
            prop_assert!(
                difference.ratio <= 1.0,
                "{}: {:?} {:?}: {} of the bounds",
                c.asked.name,
                c.graphical.answer,
                c.analytic,
                difference.ratio
            );
        } else {
            prop_assert!(c.indeterminate().is_some(), "{}: no number and no reason", c.asked.name);
        }
    }
    prop_assert!(agreement.ok());
    let numbers = agreement.compared.iter().filter(|c| c.difference.is_some()).count();
    Ok((agreement.worst_ratio(), numbers, agreement.compared.len() - numbers))
}

/// Σ |∂answer/∂number| · half a unit in the last place, by finite differences of relative 1e-7, and half a
/// unit of what the answer is a part or a difference of.
fn conditioning(d: &Drawn) -> Vec<f64> {
    const STEP: f64 = 1e-7;
    let half_unit = |x: f64| x.abs() * f64::EPSILON / 2.0;
    let values = |solution: &linkgram::graphical::Solution| -> Vec<[f64; 2]> {
        let pair = |answer: &Answer| match answer {
            Answer::Scalar { value, .. } => [*value, 0.0],
            Answer::Vector { value, .. } => *value,
            other => panic!("{other:?}"),
        };
        solution.construction.answers.iter().map(|r| pair(&r.answer)).collect()
    };
    let rest = values(&d.solution);
    let of = |letter: &str, p: linkgram::mechanism::PointId| {
        norm(vector(d, letter, &d.scene.mechanism.point(p).name).0)
    };
    let size = |asked: &Quantity, value: [f64; 2]| match *asked {
        Quantity::RelativeVelocity(b, a) => of("v", b) + of("v", a),
        Quantity::RelativeAcceleration(b, a)
        | Quantity::RelativeNormal(b, a)
        | Quantity::RelativeTangential(b, a) => of("a", b) + of("a", a),
        _ => norm(value),
    };
    let asked = d.scene.mechanism.asked.iter();
    let mut sums: Vec<f64> =
        asked.zip(&rest).map(|(asked, value)| half_unit(size(&asked.quantity, *value))).collect();
    for index in 0..common::givens::count(&d.scene.mechanism) {
        let (changed, number) = common::givens::with_changed(&d.scene.mechanism, index, |x| x * (1.0 + STEP));
        if number == 0.0 {
            continue;
        }
        let moved = linkgram::graphical::construct(&changed, &d.structure, &d.plan, d.scales).unwrap();
        for ((sum, rest), (moved, asked)) in
            sums.iter_mut().zip(&rest).zip(values(&moved).iter().zip(&d.scene.mechanism.asked))
        {
            let mut change = norm(minus(*moved, *rest));
            if matches!(asked.quantity, Quantity::Angle(_)) {
                change = change.min((std::f64::consts::TAU - change).abs());
            }
            *sum += change / (number * STEP).abs() * half_unit(number);
        }
    }
    sums
}

/// The maker makes what it should: every kind of link and guide, and chains of up to ten links.
#[test]
fn the_chains_are_of_all_kinds() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::new(common::fixed(1));
    let strategy = chains();
    let mut counts = [0; 11];
    let mut words = std::collections::BTreeMap::new();
    let mut indeterminate = 0;
    for _ in 0..CASES {
        let chain = strategy.new_tree(&mut runner).unwrap().current();
        counts[chain.count] += 1;
        for word in
            ["length\"", "line", "sides", "arms", "shape", "toward", "offset", "turned", "block", "\"cw\""]
        {
            *words.entry(word).or_insert(0) += chain.text.matches(word).count();
        }
        indeterminate += agree(&chain).unwrap().2;
    }
    assert!(counts[4..].iter().all(|&n| n > 0), "{counts:?}");
    assert!(words.values().all(|&n| n >= 10), "{words:?}");
    assert_eq!(indeterminate, 0);
}
