//! The finished sheet of problem 3-1, as a reader sees it.

use super::figure::Figure;
use super::overlap::overlaps;
use super::problem_3_1::{BOOK, LARGE, construction, scene};
use super::{Language, figure_names, single, solution};
use crate::render::svg;

fn all_figures() -> Vec<(String, Figure)> {
    let scene = scene();
    let mut all = Vec::new();
    for (name, scales) in [("book", BOOK), ("large", LARGE)] {
        let construction = construction(scales);
        all.push((format!("{name}-sheet"), solution(&scene, &construction, Language::English)));
        for figure in figure_names() {
            let figure_drawn = single(&scene, &construction, figure, Language::English).unwrap();
            all.push((format!("{name}-{figure}"), figure_drawn));
        }
    }
    all
}

#[test]
fn no_text_touches_ink_or_text_or_the_edge() {
    for (name, figure) in all_figures() {
        assert_eq!(overlaps(&figure), vec![], "{name}");
    }
}

#[test]
fn the_same_bytes_twice() {
    for ((name, one), (_, other)) in all_figures().iter().zip(&all_figures()) {
        assert_eq!(svg::write(one), svg::write(other), "{name}");
    }
}

#[test]
fn unknown_figures_are_refused() {
    assert!(single(&scene(), &construction(BOOK), "portrait", Language::English).is_none());
}

/// `SHEET_PREVIEW=folder cargo test preview` writes every figure as SVG, and as PNG where it can.
#[test]
fn preview() {
    let Some(folder) = std::env::var_os("SHEET_PREVIEW").map(std::path::PathBuf::from) else { return };
    #[cfg(feature = "png")]
    let dpi = std::env::var("SHEET_DPI").ok().and_then(|d| d.parse().ok()).unwrap_or(110.0);
    for (name, figure) in all_figures() {
        let text = svg::write(&figure);
        #[cfg(feature = "png")]
        std::fs::write(folder.join(format!("{name}.png")), crate::render::png::render(&text, dpi).unwrap())
            .unwrap();
        std::fs::write(folder.join(format!("{name}.svg")), text).unwrap();
    }
}
