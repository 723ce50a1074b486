//! Figures as pixels: grey pictures, compared with a tolerance.

use std::fmt;

use crate::render::png::{PngError, pixels};

/// A grey level may move by this much, as another version of the renderer may round.
const TOLERANCE: u8 = 1;
/// This part of the pixels may move by more.
const ALLOWED: f64 = 2e-5;

/// A grey picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    levels: Vec<u8>,
}

/// What is wrong with a picture: the decoder's own words are for those who write decoders.
fn damaged(error: png::DecodingError) -> String {
    match error {
        png::DecodingError::LimitsExceeded => "the picture is too large",
        png::DecodingError::IoError(_) => "the picture is cut off",
        png::DecodingError::Format(_) | png::DecodingError::Parameter(_) => {
            "the picture is damaged, or no PNG"
        }
    }
    .to_owned()
}

/// Where two pictures differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Black where they differ by more than the tolerance, on a pale copy of the second.
    pub picture: Picture,
    /// So many pixels differ.
    pub differing: usize,
}

/// No picture that [`Picture::png`] wrote has more pixels: a sheet of A3 at 600 dots per inch has half as many.
const MOST: usize = 1 << 27;

impl Picture {
    /// An SVG drawn on white.
    ///
    /// # Errors
    /// When the text is no SVG, or the picture would be too large.
    pub fn of_svg(svg: &str, dpi: f32) -> Result<Self, PngError> {
        let picture = pixels(svg, dpi)?;
        let part = |weight: u32, level: u8| weight * u32::from(level);
        // The weights of Rec. 601, in thousandths.
        let levels = picture
            .pixels()
            .iter()
            .map(|p| ((part(299, p.red()) + part(587, p.green()) + part(114, p.blue()) + 500) / 1000) as u8)
            .collect();
        Ok(Self { width: picture.width(), height: picture.height(), levels })
    }

    /// Reads a PNG that [`Picture::png`] wrote.
    ///
    /// # Errors
    /// One clause, where the bytes are no PNG of eight-bit grey levels.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().map_err(damaged)?;
        let size = reader.output_buffer_size().filter(|size| *size <= MOST);
        let size = size.ok_or("the picture is too large")?;
        if reader.output_color_type() != (png::ColorType::Grayscale, png::BitDepth::Eight) {
            return Err("not a picture of eight-bit grey levels".to_owned());
        }
        let mut levels = vec![0; size];
        let info = reader.next_frame(&mut levels).map_err(damaged)?;
        Ok(Self { width: info.width, height: info.height, levels })
    }

    /// The picture as PNG.
    #[must_use]
    pub fn png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&self.levels));
        // The levels fill the picture and memory takes all bytes, so this cannot fail.
        debug_assert!(written.is_ok(), "{written:?}");
        bytes
    }

    /// Its uppermost rows.
    #[must_use]
    pub fn cut(mut self, height: u32) -> Self {
        self.height = self.height.min(height);
        self.levels.truncate(self.width as usize * self.height as usize);
        self
    }

    /// Width and height in pixels.
    #[must_use]
    pub const fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    fn at(&self, x: u32, y: u32) -> Option<u8> {
        let index = y as usize * self.width as usize + x as usize;
        (x < self.width && y < self.height).then(|| self.levels.get(index).copied()).flatten()
    }

    /// Where another picture differs from this one. What only one of them covers differs.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Difference {
        let (width, height) = (self.width.max(other.width), self.height.max(other.height));
        let mut differing = 0;
        let mut levels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let (a, b) = (self.at(x, y), other.at(x, y));
                let same = matches!((a, b), (Some(a), Some(b)) if a.abs_diff(b) <= TOLERANCE);
                differing += usize::from(!same);
                levels.push(if same { 230 + b.unwrap_or(255) / 10 } else { 0 });
            }
        }
        Difference { picture: Self { width, height, levels }, differing }
    }
}

impl Difference {
    /// Whether it is more than another version of the renderer may make.
    #[must_use]
    pub fn seen(&self) -> bool {
        self.differing as f64 > ALLOWED * self.picture.levels.len() as f64
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} pixels differ", self.differing, self.picture.levels.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_survives_its_file_and_a_moved_pixel_is_seen() {
        let svg = r##"<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 20 10"><path d="M2 2 L18 8" stroke="#000" stroke-width="0.5"/></svg>"##;
        let picture = Picture::of_svg(svg, 48.0).unwrap();
        assert_eq!(Picture::read(&picture.png()).unwrap(), picture);
        assert!(!picture.difference(&picture).seen());
        let moved = Picture::of_svg(&svg.replace("18 8", "18 7.5"), 48.0).unwrap();
        assert!(picture.difference(&moved).differing > 10);
        let (width, height) = picture.size();
        let smaller = picture.clone().cut(height - 1);
        assert_eq!(picture.difference(&smaller).differing, width as usize);
        assert!(Picture::read(b"no picture").is_err());
        let mut bytes = picture.png();
        bytes[12..16].fill(0);
        assert_eq!(Picture::read(&bytes).unwrap_err(), "the picture is damaged, or no PNG");
    }
}
