//! Figures to file formats; the bytes never vary.
//!
//! **Architecture Invariant:** nothing here knows a mechanism; a [`Figure`]
//! is ink with classes.

pub mod json;
pub mod number;
#[cfg(feature = "png")]
pub mod outline;
pub mod pages;
#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "png")]
pub mod png;
mod subset;
pub mod svg;
pub mod tex;
pub mod theme;

use thiserror::Error;

use crate::sheet::figure::Figure;
use theme::Theme;

/// What a figure can be written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// Scalable vector graphics.
    #[default]
    Svg,
    /// A picture of dots.
    Png,
    /// Pages for print.
    Pdf,
    /// A picture in TikZ, for LaTeX.
    Tex,
    /// What the figure says, for programs.
    Json,
}

/// How the text of an SVG is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lettering {
    /// As text, in typefaces that the viewer has.
    Live,
    /// As outlines: looks alike everywhere, can be neither searched nor copied.
    Outline,
    /// As text, with the glyphs that it uses embedded in the file.
    #[default]
    Embed,
}

/// How a figure is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Its colours.
    pub theme: Theme,
    /// The text of an SVG.
    pub lettering: Lettering,
    /// Dots per inch of a PNG.
    pub dpi: f32,
}

/// Why a figure could not be written.
#[derive(Debug, Error)]
pub enum RenderError {
    /// This build lacks what the format needs.
    #[error("this build has no {what}: build with the feature `{feature}`")]
    NotBuilt {
        /// What is wanted.
        what: &'static str,
        /// The feature that brings it.
        feature: &'static str,
    },
    /// The figure says something that LaTeX cannot set.
    #[error(transparent)]
    Tex(#[from] tex::TexError),
    /// No picture of dots could be drawn.
    #[cfg(feature = "png")]
    #[error(transparent)]
    Png(#[from] png::PngError),
    /// No PDF could be written.
    #[cfg(feature = "pdf")]
    #[error(transparent)]
    Pdf(#[from] pdf::PdfError),
}

impl Default for Options {
    fn default() -> Self {
        Self { theme: Theme::default(), lettering: Lettering::default(), dpi: 150.0 }
    }
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::Svg, Self::Png, Self::Pdf, Self::Tex, Self::Json];

    /// Its name, which is the ending of its files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
            Self::Tex => "tex",
            Self::Json => "json",
        }
    }

    /// The format of this name, in capitals or not.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }
}

impl Lettering {
    /// The kind for a sheet that any program may open: many know no embedded typefaces, and set each run of a formula in
    /// another, wider one. Outlines where this build has them.
    #[must_use]
    pub const fn portable() -> Self {
        if cfg!(feature = "png") { Self::Outline } else { Self::Embed }
    }

    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Live, Self::Outline, Self::Embed];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Live => "live",
            Self::Outline => "outline",
            Self::Embed => "embed",
        }
    }

    /// The kind of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// The bytes of a figure in a format.
///
/// # Errors
/// When this build lacks the format, the size is out of its range, or its text cannot be written in it.
pub fn render(figure: &Figure, format: Format, options: &Options) -> Result<Vec<u8>, RenderError> {
    match format {
        Format::Svg => document_svg(figure, options).map(String::into_bytes),
        Format::Png => picture(figure, options),
        Format::Pdf => document(figure, options.theme),
        Format::Tex => Ok(tex::write(figure, options.theme)?.into_bytes()),
        Format::Json => Ok(json::write(figure).into_bytes()),
    }
}

/// A film as SVG: the figures, all of one size, one after the other, played by the viewer itself without a
/// script. Where nothing is played (on paper, in programs that know no animations, for readers who want none)
/// the last figure is shown. A film without frames is an empty text.
///
/// # Errors
/// When this build has no outlines of text and they are asked for.
pub fn film(frames: &[Figure], options: &Options) -> Result<String, RenderError> {
    let Some(figure) = svg::film(frames) else { return Ok(String::new()) };
    Ok(svg::play(&document_svg(&figure, options)?, frames.len()))
}

fn document_svg(figure: &Figure, options: &Options) -> Result<String, RenderError> {
    match options.lettering {
        Lettering::Live => Ok(svg::write_in(figure, options.theme)),
        Lettering::Embed => Ok(svg::write_embedded(figure, options.theme)),
        Lettering::Outline => outlined(figure, options.theme),
    }
}

#[cfg(feature = "png")]
fn outlined(figure: &Figure, theme: Theme) -> Result<String, RenderError> {
    Ok(outline::write(figure, theme)?)
}

#[cfg(not(feature = "png"))]
fn outlined(_: &Figure, _: Theme) -> Result<String, RenderError> {
    Err(RenderError::NotBuilt { what: "outlines of text", feature: "png" })
}

#[cfg(feature = "png")]
fn picture(figure: &Figure, options: &Options) -> Result<Vec<u8>, RenderError> {
    Ok(png::render_svg(&svg::write_in(figure, options.theme), options.dpi)?)
}

#[cfg(not(feature = "png"))]
fn picture(_: &Figure, _: &Options) -> Result<Vec<u8>, RenderError> {
    Err(RenderError::NotBuilt { what: "PNG", feature: "png" })
}

#[cfg(feature = "pdf")]
fn document(figure: &Figure, theme: Theme) -> Result<Vec<u8>, RenderError> {
    Ok(pdf::render(figure, theme)?)
}

#[cfg(not(feature = "pdf"))]
fn document(_: &Figure, _: Theme) -> Result<Vec<u8>, RenderError> {
    Err(RenderError::NotBuilt { what: "PDF", feature: "pdf" })
}
