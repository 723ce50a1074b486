//! Sheets as pixels: grey pictures through resvg, compared with a tolerance.

use linkgram::render::png::render_svg;
use resvg::tiny_skia::Pixmap;

use super::report::{Mismatch, Picture};
use super::{TITLES, golden};

/// Resolution of the golden pictures.
const DPI: f32 = 48.0;
/// The pictures in the README, by their names: the sheet whose first page it is, its resolution, and how much
/// of the page is shown, millimetres.
const TITLE_PAGES: [(&str, f32, f64); 4] = [
    ("s000-ch3a-1", 110.0, 297.0),
    ("s000-ch3a-1.solution.ar", 80.0, 297.0),
    ("s000-ch3a-1.question.en", 80.0, 190.0),
    ("s000-ch3a-1.question.ar", 80.0, 190.0),
];
/// A grey level may move by this much, as another version of the renderer may round.
const TOLERANCE: u8 = 1;
/// This part of the pixels may move by more.
const ALLOWED: f64 = 2e-5;

/// A grey picture.
#[derive(Clone, PartialEq)]
pub struct Grey {
    pub width: u32,
    pub height: u32,
    pub levels: Vec<u8>,
}

impl Grey {
    /// An SVG drawn on white.
    pub fn of_svg(svg: &str, dpi: f32) -> Self {
        let picture = Pixmap::decode_png(&render_svg(svg, dpi).unwrap()).unwrap();
        let level = |p: &resvg::tiny_skia::PremultipliedColorU8| {
            ((u32::from(p.red()) * 299 + u32::from(p.green()) * 587 + u32::from(p.blue()) * 114 + 500) / 1000)
                as u8
        };
        Self {
            width: picture.width(),
            height: picture.height(),
            levels: picture.pixels().iter().map(level).collect(),
        }
    }

    /// Its upper part.
    fn cut(mut self, height: u32) -> Self {
        self.height = self.height.min(height);
        self.levels.truncate((self.width * self.height) as usize);
        self
    }

    /// Reads a PNG that [`Grey::png`] wrote.
    fn read(bytes: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut levels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut levels).unwrap();
        assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Grayscale, png::BitDepth::Eight));
        Self { width: info.width, height: info.height, levels }
    }

    /// The picture as PNG.
    pub fn png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.write_header().unwrap().write_image_data(&self.levels).unwrap();
        bytes
    }

    fn at(&self, x: u32, y: u32) -> Option<u8> {
        (x < self.width && y < self.height).then(|| self.levels[(y * self.width + x) as usize])
    }

    /// Black where two pictures differ by more than the tolerance, on a pale copy of the second.
    pub fn difference(&self, other: &Self) -> (Self, usize) {
        let (width, height) = (self.width.max(other.width), self.height.max(other.height));
        let mut moved = 0;
        let mut levels = Vec::with_capacity((width * height) as usize);
        for y in 0..height {
            for x in 0..width {
                let (a, b) = (self.at(x, y), other.at(x, y));
                let same = matches!((a, b), (Some(a), Some(b)) if a.abs_diff(b) <= TOLERANCE);
                moved += usize::from(!same);
                levels.push(if same { 230 + b.unwrap_or(255) / 10 } else { 0 });
            }
        }
        (Self { width, height, levels }, moved)
    }
}

/// One sheet against its golden picture.
pub fn compare(name: &str, svg: &str) -> Option<Mismatch> {
    against_golden(name, &Grey::of_svg(svg, DPI))
}

fn against_golden(name: &str, actual: &Grey) -> Option<Mismatch> {
    let Ok(bytes) = std::fs::read(golden(name, "png")) else {
        return Some(Mismatch::missing(name, "there is no golden PNG"));
    };
    let expected = Grey::read(&bytes);
    let (difference, moved) = expected.difference(actual);
    let total = difference.levels.len();
    if moved as f64 <= ALLOWED * total as f64 {
        return None;
    }
    let pictures = [expected, actual.clone(), difference].map(|grey| Picture::Png(grey.png()));
    Some(Mismatch::pictures(name, &format!("{moved} of {total} pixels differ"), pictures))
}

pub fn bless(name: &str, svg: &str) {
    bless_picture(name, &Grey::of_svg(svg, DPI));
}

/// Leaves a golden alone that the picture still matches.
fn bless_picture(name: &str, actual: &Grey) {
    if against_golden(name, actual).is_some() {
        std::fs::write(golden(name, "png"), actual.png()).unwrap();
    }
}

/// The pictures in the README with their names.
fn title_pages() -> impl Iterator<Item = (&'static str, Grey)> {
    TITLES.into_iter().zip(TITLE_PAGES).map(|(name, (sheet, dpi, height))| {
        let svg = std::fs::read_to_string(golden(sheet, "svg")).unwrap();
        (name, Grey::of_svg(&svg, dpi).cut((height / 25.4 * f64::from(dpi)) as u32))
    })
}

pub fn compare_title_pages() -> Vec<Mismatch> {
    title_pages().filter_map(|(name, page)| against_golden(name, &page)).collect()
}

pub fn bless_title_pages() {
    title_pages().for_each(|(name, page)| bless_picture(name, &page));
}

#[test]
fn a_picture_survives_its_file_and_a_moved_pixel_is_seen() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 20 10"><path d="M2 2 L18 8" stroke="black" stroke-width="0.5"/></svg>"#;
    let picture = Grey::of_svg(svg, DPI);
    assert!(Grey::read(&picture.png()) == picture);
    assert_eq!(picture.difference(&picture).1, 0);
    let moved = Grey::of_svg(&svg.replace("18 8", "18 7.5"), DPI);
    assert!(picture.difference(&moved).1 > 10);
    let smaller = picture.clone().cut(picture.height - 1);
    assert_eq!(picture.difference(&smaller).1, picture.width as usize);
}
