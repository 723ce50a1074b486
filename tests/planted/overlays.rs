//! What a student gets back is to be read: on the figures of planted hand-ins no name is struck by a line or another name.

use linkgram::grade::{GradeSettings, grade_with_overlay, read_answers};
use linkgram::sheet::Figure;
use linkgram::sheet::figure::Node;
use linkgram::sheet::overlap::overlaps;

use super::campaign::{Case, plant};
use super::mistakes::Kind;

/// The figure of a hand-in: as it is, and as it is printed.
fn figure(case: &Case, printed: bool) -> Option<Figure> {
    let scene = linkgram::scene::read(&case.scene, "scene.json").unwrap();
    let answers = read_answers(&case.sheet.text, &scene).unwrap();
    let settings = GradeSettings { draughtsmen: 8, printed, ..GradeSettings::default() };
    grade_with_overlay(&scene, &answers, &settings).unwrap().1
}

/// Names that touch something, of all names.
fn struck(kinds: impl Iterator<Item = (Kind, u64)>, printed: bool) -> (usize, usize, Vec<String>) {
    let (mut figures, mut names, mut told) = (0, 0, Vec::new());
    for (kind, seed) in kinds {
        let case = plant(kind, seed);
        let Some(figure) = figure(&case, printed) else { continue };
        figures += 1;
        figure.root.walk(&mut |node| names += usize::from(matches!(node, Node::Text(_))));
        let touching = overlaps(&figure);
        if !touching.is_empty() {
            told.push(format!("{kind:?} {seed} ({}, {:?}): {touching:?}", case.family, case.style));
        }
    }
    (figures, names, told)
}

/// Of some hundred figures.
#[test]
fn names_of_both_drawings_are_to_be_read() {
    for (printed, first) in [(false, 0), (true, 1)] {
        let kinds = Kind::FORESEEN.into_iter().chain([Kind::Unforeseen]);
        let (figures, names, told) = struck(kinds.zip(first * 1000..), printed);
        println!("{figures} figures, {names} texts, {} of the figures have struck names", told.len());
        assert!(figures > 20 && names > 500);
        assert!(told.is_empty(), "{}", told.join("\n"));
    }
}

/// `OVERLAY_SEED`, `OVERLAY_EACH`: as many figures as one likes.
#[test]
#[ignore = "a count"]
fn many_figures() {
    let number = |name: &str, usual: u64| std::env::var(name).map_or(usual, |text| text.parse().unwrap());
    let (seed, each) = (number("OVERLAY_SEED", 1), number("OVERLAY_EACH", 5));
    for printed in [false, true] {
        let kinds = Kind::FORESEEN.into_iter().chain([Kind::Unforeseen]);
        let cases = kinds.flat_map(|kind| (0..each).map(move |one| (kind, seed + one)));
        let (figures, names, told) = struck(cases, printed);
        println!("printed {printed}: {figures} figures, {names} texts, {} with struck names", told.len());
        println!("{}", told.join("\n"));
    }
}
