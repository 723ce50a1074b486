//! A figure as PNG, drawn with the embedded fonts only.

use std::io::Write;
use std::sync::Arc;

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, fontdb};
use thiserror::Error;

use crate::sheet::figure::Figure;
use crate::sheet::font::{FAMILY, Face};

/// The largest side of a picture in pixels; beyond it a slip of the pen would eat the memory.
pub const LARGEST_SIDE: f64 = 32_000.0;

/// Why a figure could not be drawn as pixels.
#[derive(Debug, Error)]
pub enum PngError {
    /// The resolution is not a positive number, or the picture would be too large.
    #[error(
        "{dpi} dots per inch make a picture of {width} by {height} pixels; from 1 to {LARGEST_SIDE} pixels a side are drawn"
    )]
    Size {
        /// As asked.
        dpi: f64,
        /// Pixels.
        width: f64,
        /// Pixels.
        height: f64,
    },
    /// The SVG is not one that the renderer reads.
    #[error("the figure cannot be read back: {0}")]
    Unreadable(#[from] usvg::Error),
    /// The picture could not be encoded.
    #[error("the picture cannot be encoded: {0}")]
    Encoding(String),
}

/// Draws a figure as PNG on white at `dpi` pixels per inch.
///
/// # Errors
/// When the size is out of range.
pub fn render(figure: &Figure, dpi: f32) -> Result<Vec<u8>, PngError> {
    render_svg(&super::svg::write(figure), dpi)
}

/// So many pixels are drawn at once: of a larger picture one band after the other, for the memory that it takes.
const AT_ONCE: usize = 16_000_000;

/// Draws an SVG as PNG on white at `dpi` pixels per inch.
///
/// # Errors
/// When the size is out of range, or the text is not an SVG.
pub fn render_svg(svg: &str, dpi: f32) -> Result<Vec<u8>, PngError> {
    Picture::read(svg, dpi)?.encoded(AT_ONCE)
}

/// The pixels of an SVG on white at `dpi` pixels per inch.
pub(crate) fn pixels(svg: &str, dpi: f32) -> Result<Pixmap, PngError> {
    let picture = Picture::read(svg, dpi)?;
    picture.rows(0, picture.height)
}

/// A picture that is to be drawn.
struct Picture {
    tree: usvg::Tree,
    dpi: f64,
    scale: f32,
    /// Pixels.
    width: u32,
    height: u32,
}

impl Picture {
    fn read(svg: &str, dpi: f32) -> Result<Self, PngError> {
        let dpi = f64::from(dpi);
        let tree = parse(svg)?;
        // usvg resolves millimetres at its own 96 pixels per inch.
        let scale = dpi / 96.0;
        let width = (f64::from(tree.size().width()) * scale).ceil();
        let height = (f64::from(tree.size().height()) * scale).ceil();
        let in_range = |side: f64| (1.0..=LARGEST_SIDE).contains(&side);
        if !(in_range(width) && in_range(height)) {
            return Err(PngError::Size { dpi, width, height });
        }
        Ok(Self { tree, dpi, scale: scale as f32, width: width as u32, height: height as u32 })
    }

    /// So many rows of pixels from one on.
    fn rows(&self, from: u32, count: u32) -> Result<Pixmap, PngError> {
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let pixels = Pixmap::new(self.width, count);
        let mut pixels = pixels.ok_or(PngError::Size { dpi: self.dpi, width, height })?;
        pixels.fill(Color::WHITE);
        let placed = Transform::from_scale(self.scale, self.scale).post_translate(0.0, -(from as f32));
        resvg::render(&self.tree, placed, &mut pixels.as_mut());
        Ok(pixels)
    }

    /// As PNG, drawn in bands of so many pixels where it has more.
    fn encoded(&self, at_once: usize) -> Result<Vec<u8>, PngError> {
        let rows = u32::try_from(at_once / self.width as usize).unwrap_or(u32::MAX).max(1);
        if rows >= self.height {
            let pixels = self.rows(0, self.height)?;
            return pixels.encode_png().map_err(|error| PngError::Encoding(error.to_string()));
        }
        let wrong = |error: png::EncodingError| PngError::Encoding(error.to_string());
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(wrong)?;
        let mut stream = writer.stream_writer().map_err(wrong)?;
        let mut from = 0;
        while from < self.height {
            let band = self.rows(from, rows.min(self.height - from))?;
            // On white nothing is seen through: these are the plain colours.
            let written = stream.write_all(band.data());
            written.map_err(|error| PngError::Encoding(error.to_string()))?;
            from += band.height();
        }
        stream.finish().map_err(wrong)?;
        writer.finish().map_err(wrong)?;
        Ok(bytes)
    }
}

/// Reads an SVG with the embedded fonts.
///
/// # Errors
/// When the text is not an SVG.
pub fn parse(svg: &str) -> Result<usvg::Tree, PngError> {
    let mut fonts = fontdb::Database::new();
    for face in Face::ALL {
        fonts.load_font_data(face.bytes().to_vec());
    }
    // A character that no face has falls back to the family itself: a box, never a system font.
    fonts.set_serif_family(FAMILY);
    fonts.set_sans_serif_family(FAMILY);
    let options =
        usvg::Options { font_family: FAMILY.to_owned(), fontdb: Arc::new(fonts), ..usvg::Options::default() };
    Ok(usvg::Tree::from_str(svg, &options)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In bands a picture is the same picture.
    #[test]
    fn bands_are_one_picture() {
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
            <path d="M2 3 L37 26 M5 28 C20 2 25 40 39 1" stroke="black" stroke-width="0.5" fill="none"/>
            <circle cx="20" cy="15" r="9.3" fill="grey"/></svg>"#;
        let picture = Picture::read(svg, 200.0).unwrap();
        let [whole, banded] = [usize::MAX, 7000].map(|at_once| {
            let encoded = picture.encoded(at_once).unwrap();
            Pixmap::decode_png(&encoded).unwrap()
        });
        assert!(picture.height > 100 && whole.width() == banded.width());
        // A pixel is covered by four samples in its height, of which rounding may move one across an edge; a row that is
        // missing or shifted would be black for white.
        let apart = whole.data().iter().zip(banded.data()).map(|(a, b)| a.abs_diff(*b));
        let most = apart.max().unwrap();
        assert!(most <= 64, "{most}");
    }
}
