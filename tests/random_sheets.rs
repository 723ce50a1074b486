//! Sheets of random chains: nothing touches, in any language, in question and solution.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

use crate::common::chains::chains;
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

/// How many sheets are kept as pictures where somebody wants to look at them.
#[cfg(feature = "png")]
const KEPT: usize = 40;

/// Keeps the picture of a sheet in the folder that `LINKGRAM_SHEETS` names, to be looked at.
#[cfg(feature = "png")]
fn keep(figure: &Figure, name: &str) {
    static WRITTEN: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
    let Some(folder) = std::env::var_os("LINKGRAM_SHEETS") else { return };
    let number = WRITTEN.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    if number >= KEPT {
        return;
    }
    let options = linkgram::render::Options { dpi: 70.0, ..Default::default() };
    let bytes = linkgram::render::render(figure, linkgram::render::Format::Png, &options).unwrap();
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(std::path::Path::new(&folder).join(format!("{number:02}-{name}.png")), bytes).unwrap();
}

#[cfg(not(feature = "png"))]
fn keep(_: &Figure, _: &str) {}

proptest! {
    // A crowd is a crowd: a smaller one that fails tells no more, and takes minutes to find.
    #![proptest_config(ProptestConfig { max_shrink_iters: 0, ..common::fixed(CASES) })]

    #[test]
    fn nothing_touches_on_the_sheet_of_a_random_chain(chain in chains(), language in 0..4_usize) {
        let scene = common::read(&chain.text);
        let language = Language::ALL[language];
        for question in [false, true] {
            let figure = drawn(&scene, question, language);
            keep(&figure, &format!("{}-{}", if question { "question" } else { "solution" }, figure.language));
            let touching = overlaps(&figure);
            prop_assert!(touching.is_empty(), "question {question}, {language:?}: {touching:#?}\n{}", chain.text);
        }
    }
}
