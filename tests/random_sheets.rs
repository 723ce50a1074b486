//! Sheets of random chains: nothing touches, in any language, in question and solution.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod common;

use common::chains::chains;
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::overlap::overlaps;
use linkgram::sheet::{self, Figure, Language};
use proptest::prelude::*;

const CASES: u32 = 200;

fn drawn(scene: &Scene, question: bool, language: Language) -> Figure {
    let scales = if question { sheet::scale::for_question } else { sheet::scale::for_scene };
    let solved = linkgram::solve::solve(scene, Extent::WholeSkeleton, scales).unwrap();
    let construction = &solved.solution.construction;
    if question {
        sheet::question(scene, construction, language)
    } else {
        sheet::solution(scene, construction, language)
    }
}

proptest! {
    // A crowd is a crowd: a smaller one that fails tells no more, and takes minutes to find.
    #![proptest_config(ProptestConfig { max_shrink_iters: 0, ..common::fixed(CASES) })]

    #[test]
    fn nothing_touches_on_the_sheet_of_a_random_chain(chain in chains(), language in 0..4_usize) {
        let scene = common::read(&chain.text);
        let language = Language::ALL[language];
        for question in [false, true] {
            let figure = drawn(&scene, question, language);
            let touching = overlaps(&figure);
            prop_assert!(touching.is_empty(), "question {question}, {language:?}: {touching:#?}\n{}", chain.text);
        }
    }
}
