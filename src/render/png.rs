//! A figure as PNG, drawn with the embedded fonts only.

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

/// Draws an SVG as PNG on white at `dpi` pixels per inch.
///
/// # Errors
/// When the size is out of range, or the text is not an SVG.
pub fn render_svg(svg: &str, dpi: f32) -> Result<Vec<u8>, PngError> {
    pixels(svg, dpi)?.encode_png().map_err(|e| PngError::Encoding(e.to_string()))
}

/// The pixels of an SVG on white at `dpi` pixels per inch.
pub(crate) fn pixels(svg: &str, dpi: f32) -> Result<Pixmap, PngError> {
    let dpi = f64::from(dpi);
    let tree = parse(svg)?;
    // usvg resolves millimetres at its own 96 pixels per inch.
    let scale = dpi / 96.0;
    let width = (f64::from(tree.size().width()) * scale).ceil();
    let height = (f64::from(tree.size().height()) * scale).ceil();
    let in_range = |side: f64| (1.0..=LARGEST_SIDE).contains(&side);
    let size_error = || PngError::Size { dpi, width, height };
    if !(in_range(width) && in_range(height)) {
        return Err(size_error());
    }
    let mut pixels = Pixmap::new(width as u32, height as u32).ok_or_else(size_error)?;
    pixels.fill(Color::WHITE);
    let scale = scale as f32;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    Ok(pixels)
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
