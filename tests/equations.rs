//! The vector equations of the steps are true of what is drawn: both sides of each, added up on the paper, are one vector.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;
use linkgram::graphical::construction::{Term, TermDirection, Vector};
use linkgram::plan::Extent;
use linkgram::sheet::scale;
use linkgram::solve::solve;

/// The vector that a term stands for: it bears the name, and has the direction that the table of terms tells.
fn drawn<'v>(term: &Term, vectors: &'v [Vector]) -> Result<Option<&'v Vector>, ()> {
    let named = || vectors.iter().filter(|vector| vector.quantity == term.quantity);
    match term.direction {
        Some(TermDirection::Claim(claim)) => {
            // What is zero has no direction to be held to, and a whole vector claims none.
            let own = named().find(|vector| vector.claim == Some(claim));
            let own = own.or(named().find(|v| v.is_zero || v.claim.is_none()));
            if own.is_none() && named().next().is_some() { Err(()) } else { Ok(own) }
        }
        _ => Ok(named().next()),
    }
}

#[test]
fn every_vector_equation_closes_on_the_paper() {
    let (mut closed, mut wrong) = (0, Vec::new());
    for (name, scene) in common::scenes() {
        let Ok(solved) = solve(&scene, Extent::WholeSkeleton, scale::for_scene) else { continue };
        let construction = &solved.solution.construction;
        for step in &construction.steps {
            let Some(diagram) = construction.diagram(step.diagram) else { continue };
            for equation in &step.equations {
                let told = |terms: &[Term]| {
                    terms.iter().map(|t| t.quantity.name(&scene.mechanism)).collect::<Vec<_>>().join(" + ")
                };
                let say = format!("{name}: {} = {}", told(&equation.left), told(&equation.right));
                let mut apart = Some([0.0; 2]);
                for (sign, terms) in [(1.0, &equation.left), (-1.0, &equation.right)] {
                    for term in terms {
                        match (drawn(term, &diagram.vectors), apart) {
                            (Err(()), _) => {
                                wrong.push(format!(
                                    "{say}: {} has another direction",
                                    term.quantity.name(&scene.mechanism)
                                ));
                                apart = None;
                            }
                            (Ok(Some(v)), Some(sum)) => {
                                apart = Some([0, 1].map(|k| sum[k] + sign * (v.to[k] - v.from[k])));
                            }
                            _ => apart = None,
                        }
                    }
                }
                let Some([x, y]) = apart else { continue };
                closed += 1;
                if libm::hypot(x, y) > 1e-6 {
                    wrong.push(format!("{say}: {x:.4} {y:.4} mm"));
                }
            }
        }
    }
    assert!(closed > 300, "{closed}");
    assert!(wrong.is_empty(), "{} of {closed}: {wrong:#?}", wrong.len());
}
