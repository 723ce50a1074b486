//! The pictures in the README: first pages of golden sheets.

use linkgram::golden::pixels::Picture;

use super::root;

/// By their names: the sheet whose first page it is, its resolution, and how much of the page is shown,
/// millimetres.
const PICTURES: [(&str, &str, f32, f64); 4] = [
    ("title-page", "s000-ch3a-1", 110.0, 297.0),
    ("title-page-ar", "s000-ch3a-1.solution.ar", 80.0, 297.0),
    ("question-page", "s000-ch3a-1.question.en", 80.0, 190.0),
    ("question-page-ar", "s000-ch3a-1.question.ar", 80.0, 190.0),
];

#[test]
fn the_pictures_in_the_readme_are_of_the_golden_sheets() {
    let blessing = std::env::var_os("LINKGRAM_BLESS").is_some_and(|v| v == "1");
    for (name, sheet, dpi, height) in PICTURES {
        let path = root().join(format!("golden/{name}.png"));
        let svg = std::fs::read_to_string(root().join(format!("golden/{sheet}.svg"))).unwrap();
        let page = Picture::of_svg(&svg, dpi).unwrap().cut((height / 25.4 * f64::from(dpi)) as u32);
        let shown = std::fs::read(&path).ok().map(|bytes| Picture::read(&bytes).unwrap());
        let differs = shown.is_none_or(|shown| shown.difference(&page).seen());
        if blessing && differs {
            std::fs::write(&path, page.png()).unwrap();
        } else {
            assert!(!differs, "{path:?} is not of the golden sheet; bless once more with LINKGRAM_BLESS=1");
        }
    }
}
