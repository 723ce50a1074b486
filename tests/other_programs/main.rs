//! The formats as other programs draw them: Chromium the SVG, Poppler the PDF, LaTeX the TikZ picture, each
//! against our own picture of dots.
//!
//! The programs are not everywhere, so these tests wait to be asked for. On Debian:
//!
//! ```sh
//! apt-get install chromium poppler-utils texlive-latex-base texlive-latex-recommended texlive-pictures
//! cargo test --test all other_programs:: -- --ignored
//! ```
//!
//! The pictures stay in `target/other-programs`. Two pictures are compared by their ink: the sum of all
//! differences of grey as a part of the sum of all grey in ours, in cells of 0.4 mm, a tenth of a letter: how a
//! program smooths edges, and that it sets letters to whole dots, then counts for as little as it shows.

#![cfg(all(feature = "png", feature = "pdf"))]
#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Dots per millimetre: the edges of pages fall between dots.
const DOTS: usize = 10;
/// Side of a cell in which ink is compared, dots.
const CELL: usize = 4;
/// Chromium may differ by these parts of the ink, where the text is outlines, live, and live with embedded
/// typefaces: its smoothing of edges, and of small letters in its own way. Measured: 0.024, 0.061, 0.079.
const CHROMIUM: [(&str, f64); 3] = [("outline", 0.03), ("live", 0.075), ("embed", 0.095)];
/// Poppler may differ by this part: it sets every letter to whole dots. Measured: 0.126; at twice the
/// resolution half of that.
const POPPLER: f64 = 0.14;
/// What LaTeX sets in its own type differs in every letter; the strokes may differ by this part. Measured:
/// 0.060, on pages with nothing but rules and ticks.
const LATEX_STROKES: f64 = 0.075;
/// This part of the ink may stand where the other picture has none within a millimetre. Measured: 0.0002.
const LATEX_STRAY: f64 = 0.001;

/// Ten sheets: every kind of symbol, one page to four.
const TEN: [&str; 10] = [
    "s000-ch3a-1",
    "s000-ch3a-4",
    "s000-ch3b-2",
    "s000-ch3b-12",
    "s000-ch4-1",
    "s000-ch4-3-60",
    "s000-ch4-6-a",
    "s000-ch4-11-b",
    "s000-ch7-9-36",
    "eight-link",
];

/// A folder of this test's own for the files of one sheet.
fn folder(of: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap().join("other-programs").join(of);
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn run(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{command:?}\n{}{}", text(&output.stdout), text(&output.stderr));
    output
}

/// Draws a sheet; `outputs` are names of files in its folder.
fn draw(name: &str, options: &[&str], outputs: &[&str]) -> PathBuf {
    let folder = folder(name);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(format!("{name}.json"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkgram"));
    command.arg("draw").arg(scene).args(options);
    if outputs.iter().any(|output| output.ends_with(".png")) {
        command.args(["--dpi", "254"]);
    }
    for output in outputs {
        command.arg("-o").arg(folder.join(output));
    }
    run(&mut command);
    folder
}

/// Grey levels, 0 for white.
struct Ink {
    width: usize,
    height: usize,
    levels: Vec<f64>,
}

impl Ink {
    fn read(path: &Path) -> Self {
        let file = std::fs::File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        let grey = |dot: &[u8]| {
            let level = |part: u8, share: f64| f64::from(255 - part) * share;
            match *dot {
                [l] => level(l, 1.0),
                [l, a] => level(l, f64::from(a) / 255.0),
                [r, g, b] => level(r, 0.299) + level(g, 0.587) + level(b, 0.114),
                [r, g, b, a] => (level(r, 0.299) + level(g, 0.587) + level(b, 0.114)) * f64::from(a) / 255.0,
                _ => unreachable!("a dot has at most four parts"),
            }
        };
        let levels = bytes.chunks_exact(info.color_type.samples()).map(grey).collect();
        Self { width: info.width as usize, height: info.height as usize, levels }
    }

    /// Its rows from `top` on.
    fn page(&self, top: usize, height: usize) -> Self {
        let height = height.min(self.height - top);
        let levels = self.levels[top * self.width..(top + height) * self.width].to_vec();
        Self { width: self.width, height, levels }
    }

    fn cell(&self, x: usize, y: usize) -> f64 {
        let mut sum = 0.0;
        for y in y * CELL..((y + 1) * CELL).min(self.height) {
            for x in x * CELL..((x + 1) * CELL).min(self.width) {
                sum += self.levels[y * self.width + x];
            }
        }
        sum
    }

    /// The part of our ink by which the other differs.
    fn difference(&self, other: &Self) -> f64 {
        assert!(self.width.abs_diff(other.width) <= 2, "{} and {} dots wide", self.width, other.width);
        let (mut ink, mut differing) = (0.0, 0.0);
        for y in 0..self.height.div_ceil(CELL) {
            for x in 0..self.width.div_ceil(CELL) {
                let (a, b) = (self.cell(x, y), other.cell(x, y));
                ink += a;
                differing += (a - b).abs();
            }
        }
        differing / ink
    }
}

/// Chromium's picture of an SVG; `fonts` is a folder with typefaces to be installed, if any.
fn chromium(svg: &Path, size: &Ink, fonts: Option<&Path>) -> Ink {
    let folder = svg.parent().unwrap();
    let picture = svg.with_extension("chromium.png");
    let css = |dots: usize| (dots as f64 * 96.0 / 254.0).ceil() as usize;
    let mut command = Command::new("chromium");
    if let Some(fonts) = fonts {
        let configuration = folder.join("fonts.conf");
        let (fonts, cache) = (fonts.display(), folder.join("cache"));
        let text = format!(
            "<?xml version=\"1.0\"?><fontconfig><dir>{fonts}</dir><cachedir>{}</cachedir></fontconfig>",
            cache.display()
        );
        std::fs::write(&configuration, text).unwrap();
        command.env("FONTCONFIG_FILE", &configuration);
    }
    run(command
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--font-render-hinting=none",
        ])
        .args(["--disable-lcd-text", "--force-color-profile=srgb", "--virtual-time-budget=10000"])
        .arg(format!("--force-device-scale-factor={}", 254.0 / 96.0))
        .arg(format!("--window-size={},{}", css(size.width), css(size.height)))
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(format!("--screenshot={}", picture.display()))
        .arg(format!("file://{}", svg.display())));
    let taken = Ink::read(&picture);
    // The window is rounded up to whole units: cut it to the sheet.
    let levels = taken.levels.chunks_exact(taken.width).take(size.height);
    let levels: Vec<f64> = levels.flat_map(|row| &row[..size.width.min(taken.width)]).copied().collect();
    Ink { width: size.width.min(taken.width), height: size.height.min(taken.height), levels }
}

#[test]
#[ignore = "needs chromium"]
fn chromium_draws_the_same() {
    let fonts = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/render/fonts");
    for name in TEN {
        let folder = draw(name, &["--text", "live"], &["live.svg", "sheet.png"]);
        draw(name, &["--text", "outline"], &["outline.svg"]);
        draw(name, &["--text", "embed"], &["embed.svg"]);
        let ours = Ink::read(&folder.join("sheet.png"));
        for (kind, limit) in CHROMIUM {
            // Live text needs its typefaces installed; with the others nothing of ours is.
            let installed = (kind == "live").then_some(fonts.as_path());
            let part = ours.difference(&chromium(&folder.join(format!("{kind}.svg")), &ours, installed));
            println!("{name}: {kind} {part:.4}");
            assert!(part < limit, "{name}, {kind}: {part}");
        }
    }
}

/// The pages of a PDF as Poppler draws them.
fn poppler(pdf: &Path) -> Vec<Ink> {
    let folder = pdf.parent().unwrap();
    let stem = pdf.file_stem().unwrap().to_str().unwrap();
    let stem = format!("{stem}.poppler");
    run(Command::new("pdftocairo").args(["-r", "254", "-gray", "-png"]).arg(pdf).arg(folder.join(&stem)));
    let mut pages: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.file_name().unwrap().to_str().unwrap().starts_with(&format!("{stem}-")))
        .collect();
    pages.sort();
    pages.iter().map(|path| Ink::read(path)).collect()
}

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

#[test]
#[ignore = "needs poppler-utils"]
fn poppler_draws_the_pdf_the_same_and_its_text_can_be_copied() {
    for name in TEN {
        let folder = draw(name, &[], &["sheet.pdf", "sheet.png", "sheet.json"]);
        let pdf = folder.join("sheet.pdf");
        let ours = Ink::read(&folder.join("sheet.png"));
        let pages = poppler(&pdf);
        let height = 297 * DOTS;
        assert_eq!(pages.len(), ours.height / height, "{name}: one page each");
        for (i, page) in pages.iter().enumerate() {
            let part = ours.page(i * height, height).difference(page);
            println!("{name}, page {}: {part:.4}", i + 1);
            assert!(part < POPPLER, "{name}, page {}: {part}", i + 1);
        }
        let fonts = String::from_utf8(run(Command::new("pdffonts").arg(&pdf)).stdout).unwrap();
        for line in fonts.lines().skip(2) {
            // Embedded, a subset, with a table to characters.
            assert!(line.contains("yes yes yes"), "{name}: {line}");
        }
        // Every word of the figure that stands in one line without scripts is found in the copied text.
        let copied = String::from_utf8(run(Command::new("pdftotext").arg(&pdf).arg("-")).stdout).unwrap();
        let copied: BTreeSet<String> = words(&copied).into_iter().collect();
        let figure: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(folder.join("sheet.json")).unwrap()).unwrap();
        let mut missing = Vec::new();
        for page in figure["pages"].as_array().unwrap() {
            for text in page["texts"].as_array().unwrap() {
                let text = text["text"].as_str().unwrap();
                let plain = |w: &String| w.len() > 3 && w.chars().all(|c| c.is_ascii_lowercase());
                missing.extend(words(text).into_iter().filter(plain).filter(|w| !copied.contains(w)));
            }
        }
        assert!(missing.is_empty(), "{name}: cannot be copied: {missing:?}");
    }
}

/// Joined letters are copied as the letters they are, in the order in which they are read.
#[test]
#[ignore = "needs poppler-utils"]
fn arabic_and_persian_can_be_copied_from_the_pdf() {
    for (language, caption) in [("ar", "مخطط السرعة"), ("fa", "دیاگرام سرعت")] {
        let name = format!("{language}.pdf");
        let pdf = draw("s000-ch3a-1", &["--lang", language], &[&name]).join(name);
        let copied = String::from_utf8(run(Command::new("pdftotext").arg(&pdf).arg("-")).stdout).unwrap();
        // Marks of direction stand between the words.
        let letters = |c: &char| !matches!(c, '\u{202a}'..='\u{202e}');
        let copied: String = copied.chars().filter(letters).collect();
        assert!(copied.contains(caption), "{language}: {caption} is not in\n{copied}");
    }
}

/// Compiles a file with LaTeX; its pages as Poppler draws them.
fn latex(tex: &Path) -> Vec<Ink> {
    let folder = tex.parent().unwrap();
    run(Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", "-output-directory"])
        .arg(folder)
        .arg(tex)
        .current_dir(folder));
    poppler(&tex.with_extension("pdf"))
}

/// The same figure without its words: only the strokes can be compared.
fn without_text(tex: &str) -> String {
    tex.lines().filter(|line| !line.starts_with("\\linkgramtext{")).map(|line| format!("{line}\n")).collect()
}

#[test]
#[ignore = "needs a LaTeX and poppler-utils"]
fn latex_sets_the_same_figure() {
    for name in &TEN[..5] {
        let folder = draw(name, &[], &["tikz.tex", "sheet.svg", "sheet.png"]);
        let tex = std::fs::read_to_string(folder.join("tikz.tex")).unwrap();
        let ours = Ink::read(&folder.join("sheet.png"));
        let height = 297 * DOTS;
        let whole = latex(&folder.join("tikz.tex"));
        assert_eq!(whole.len(), ours.height / height, "{name}: one page each");

        // The strokes fall on ours, dot by dot.
        std::fs::write(folder.join("strokes.tex"), without_text(&tex)).unwrap();
        let strokes = latex(&folder.join("strokes.tex"));
        let svg = std::fs::read_to_string(folder.join("sheet.svg")).unwrap();
        let bare: String =
            svg.lines().filter(|l| !l.starts_with("<text")).map(|l| format!("{l}\n")).collect();
        let picture = linkgram::render::png::render_svg(&bare, 254.0).unwrap();
        std::fs::write(folder.join("strokes.png"), picture).unwrap();
        let bare = Ink::read(&folder.join("strokes.png"));
        for (i, page) in strokes.iter().enumerate() {
            let mine = bare.page(i * height, height);
            if mine.levels.iter().sum::<f64>() > 0.0 {
                let part = mine.difference(page);
                println!("{name}, page {}: strokes {part:.4}", i + 1);
                assert!(part < LATEX_STROKES, "{name}, page {}: {part}", i + 1);
            }
        }
        // The words cover the same places: ink within 1 mm of ours, and ours within 1 mm of it.
        for (i, page) in whole.iter().enumerate() {
            let mine = ours.page(i * height, height);
            let stray = stray(&mine, page).max(stray(page, &mine));
            println!("{name}, page {}: stray {stray:.5}", i + 1);
            assert!(stray < LATEX_STRAY, "{name}, page {}: {stray}", i + 1);
        }
    }
}

/// The part of the ink of `a` that has no ink of `b` within a millimetre.
fn stray(a: &Ink, b: &Ink) -> f64 {
    let columns = b.width.div_ceil(DOTS);
    let rows = b.height.div_ceil(DOTS);
    let mut inked = vec![false; columns * rows];
    for (i, level) in b.levels.iter().enumerate() {
        if *level > 40.0 {
            inked[i / b.width / DOTS * columns + i % b.width / DOTS] = true;
        }
    }
    let near = |x: usize, y: usize| {
        let (column, row) = (x / DOTS, y / DOTS);
        (row.saturating_sub(1)..=(row + 1).min(rows - 1)).any(|r| {
            (column.saturating_sub(1)..=(column + 1).min(columns - 1)).any(|c| inked[r * columns + c])
        })
    };
    let (mut all, mut far) = (0.0, 0.0);
    for (i, level) in a.levels.iter().enumerate() {
        all += level;
        if *level > 40.0 && !near(i % a.width, i / a.width) {
            far += level;
        }
    }
    far / all
}

#[test]
#[ignore = "needs a LaTeX"]
fn a_document_inputs_the_figure_and_restyles_it() {
    let folder = draw("s000-ch3a-1", &["--figure", "velocity", "--theme", "colour"], &["velocity.tex"]);
    let document = r"\documentclass{article}
\usepackage{tikz}
\usetikzlibrary{arrows.meta}
\tikzset{linkgram velocity ink/.style=red}
\begin{document}
The velocity diagram:

\input{velocity.tex}

Text after it.
\end{document}
";
    std::fs::write(folder.join("document.tex"), document).unwrap();
    let pages = latex(&folder.join("document.tex"));
    assert_eq!(pages.len(), 1);
    let text = run(Command::new("pdftotext").arg(folder.join("document.pdf")).arg("-")).stdout;
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("The velocity diagram") && text.contains("Text after it"), "{text}");
    let folder = folder.join("document.pdf");
    run(Command::new("pdftoppm")
        .args(["-r", "100", "-png"])
        .arg(&folder)
        .arg(folder.with_extension("colour")));
    let picture = folder.with_file_name("document.colour-1.png");
    let mut reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(picture).unwrap()))
        .read_info()
        .unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    let red = bytes.chunks_exact(3).filter(|dot| dot[0] > 200 && dot[1] < 80 && dot[2] < 80).count();
    let blue = bytes.chunks_exact(3).filter(|dot| dot[2] > 150 && dot[0] < 80).count();
    assert!(red > 100 && blue == 0, "the document's colour, not the theme's: {red} red dots, {blue} blue");
}
